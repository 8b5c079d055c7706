// Nonlinear, routing, sampled and hybrid blocks.
#include "tests/blocks/bench.h"
#include "tests/catch.h"

namespace flyball::test {

TEST_CASE("Saturation and DeadZone divide the signal between them") {
  Device limited("Saturation", {{"lower", -0.5}, {"upper", 2.0}});
  Device rest("DeadZone", {{"lower", -0.5}, {"upper", 2.0}});
  for (const double u : {-3.0, -0.5, 0.25, 2.0, 8.0}) {
    limited["u"] = u, rest["u"] = u;
    limited.update(), rest.update();
    INFO("u = " << u);
    CHECK(limited["y"] == std::clamp(u, -0.5, 2.0));
    CHECK(limited["y"] + rest["y"] == u);
  }
}

TEST_CASE("Relay switches on and off at different levels") {
  Device d("Relay", {{"switch_on", 2.0}, {"switch_off", 1.0}, {"on", 10.0}, {"off", -10.0}});
  d["u"] = 1.5;
  d.update();
  CHECK(d["y"] == -10.0);
  CHECK(d["turns_on"] == -0.5);
  CHECK(d["turns_off"] == 0.5);
  d.handle(Phase::crossing, "turns_on");
  d.update();
  CHECK(d["y"] == 10.0);
  d.handle(Phase::crossing, "turns_off");
  d.update();
  CHECK(d["y"] == -10.0);
}

TEST_CASE("Relay does not feed its input through") {
  const BlockObject object = create("Relay");
  const int y = object.specification->port("y")->slots[0], u = object.specification->port("u")->slots[0];
  CHECK(std::ranges::count(object.reads[y], u) == 0);
}

TEST_CASE("Switch passes u1 while its control exceeds the threshold") {
  Device d("Switch", {{"threshold", 0.5}});
  d["u1"] = 1.0, d["u3"] = 3.0;
  d["control"] = 0.75;
  CHECK(d.update()["y"] == 1.0);
  d["control"] = 0.25;
  CHECK(d.update()["y"] == 3.0);
}

TEST_CASE("Mux and Demux pass their elements without a copy") {
  const BlockObject mux = create("Mux", {{"inputs", 3.0}}), demux = create("Demux", {{"outputs", 3.0}});
  CHECK(mux.specification->port("y")->elements == std::vector<std::string>{"1", "2", "3"});
  CHECK(mux.type->kernels.on_double.outputs == nullptr);
  for (const Specification* spec : {mux.specification, demux.specification}) {
    REQUIRE(spec->passed.size() == 3);
  }
  for (int k = 0; k < 3; ++k) {
    const std::string number = std::to_string(k + 1);
    CHECK(mux.specification->passed[k].input == mux.specification->port("u" + number)->slots[0]);
    CHECK(mux.specification->passed[k].output == mux.specification->port("y")->slots[k]);
    CHECK(demux.specification->passed[k].input == demux.specification->port("u")->slots[k]);
    CHECK(demux.specification->passed[k].output == demux.specification->port("y" + number)->slots[0]);
  }
}

TEST_CASE("Quantizer keeps its level within half an interval, and follows jumps over several by value") {
  Device d("Quantizer", {{"interval", 0.5}});
  d["u"] = 0.2;
  CHECK(d.update()["y"] == 0.0);
  CHECK(d["rises"] < 0.0);
  d["u"] = 1.3;
  // Within the instant of the jump already, before the level is committed.
  CHECK(d.update()["y"] == 1.5);
  d.handle(Phase::crossing, "rises");
  CHECK(d["level"] == 3.0);
  d.update();
  CHECK(d["y"] == 1.5);
  CHECK((d["rises"] < 0.0 && d["falls"] > 0.0));
  d["u"] = -0.8;
  CHECK(d.update()["y"] == -1.0);
  d.handle(Phase::crossing, "falls");
  CHECK(d["level"] == -2.0);
}

TEST_CASE("Quantizer located at the edge of a level takes the next one, however the division rounds") {
  Device d("Quantizer", {{"interval", 0.1}});
  for (int k = 0; k < 100; ++k) {
    d["level"] = k, d["u"] = (k + 0.5) * 0.1;
    d.handle(Phase::crossing, "rises");
    CHECK(d["level"] == k + 1);
    d.update();
    // What was the edge upwards is, in the same bits, the edge downwards.
    CHECK(d["falls"] == 0.0);
  }
}

TEST_CASE("RateLimiter rises and falls at its limits, and between them follows with tau") {
  Device d("RateLimiter", {{"rising", 2.0}, {"falling", -3.0}, {"tau", 0.25}, {"initial", 1.0}});
  for (const auto& [u, rate] : {std::pair{5.0, 2.0}, {1.25, 1.0}, {1.0, 0.0}, {0.5, -2.0}, {-4.0, -3.0}}) {
    d["u"] = u;
    d.update();
    INFO("u = " << u);
    CHECK(d.rate("x") == rate);
  }
}

TEST_CASE("DiscreteRateLimiter moves by at most a rate times the sample time") {
  Device d(
      "DiscreteRateLimiter",
      {{"rising", 2.0}, {"falling", -3.0}, {"sample_time", *Rational::fraction(1, 2)}, {"initial", 1.0}});
  std::vector<double> shown;
  for (const double u : {3.5, 3.5, 3.5, 0.0, 0.0, 0.0}) {
    d["u"] = u;
    shown.push_back(d.hit("y"));
  }
  CHECK(shown == std::vector<double>{2.0, 3.0, 3.5, 2.0, 0.5, 0.0});
}

TEST_CASE("Backlash rests inside of its play and is pushed at its ends") {
  Device d("Backlash", {{"width", 1.0}, {"tau", 0.25}, {"initial", 2.0}});
  for (const auto& [u, rate] : {std::pair{2.4, 0.0}, {2.75, 1.0}, {1.6, 0.0}, {1.0, -2.0}}) {
    d["u"] = u;
    d.update();
    INFO("u = " << u);
    CHECK(d.rate("x") == rate);
  }
}

TEST_CASE("DiscreteBacklash follows behind its play") {
  Device d("DiscreteBacklash", {{"width", 1.0}, {"sample_time", Rational(1)}});
  std::vector<double> shown;
  for (const double u : {0.25, 1.0, 3.0, 2.5, 2.0, 1.5, 4.0}) {
    d["u"] = u;
    shown.push_back(d.hit("y"));
  }
  CHECK(shown == std::vector<double>{0.0, 0.5, 2.5, 2.5, 2.5, 2.0, 3.5});
}

TEST_CASE("UnitDelay shows its input one hit later") {
  Device d("UnitDelay", {{"sample_time", Rational(1)}, {"initial", 7.0}});
  std::vector<double> shown;
  for (const double u : {1.0, 2.0, 3.0}) {
    d["u"] = u;
    shown.push_back(d.hit("y"));
  }
  CHECK(shown == std::vector<double>{7.0, 1.0, 2.0});
}

TEST_CASE("ZeroOrderHold shows its input at the hit") {
  Device d("ZeroOrderHold", {{"sample_time", Rational(1)}});
  d["u"] = 4.0;
  CHECK(d.hit("y") == 4.0);
}

TEST_CASE("BouncingBall falls freely and turns its speed at the ground") {
  Device d("BouncingBall", {{"gravity", 10.0}, {"restitution", 0.5}, {"initial_height", 3.0}});
  d.update();
  CHECK(d["height"] == 3.0);
  CHECK(d["ground"] == 3.0);
  d["h"] = -1e-16, d["w"] = -4.0;
  d.update();
  CHECK(d.rate("h") == -4.0);
  CHECK(d.rate("w") == -10.0);
  d.handle(Phase::crossing, "ground");
  CHECK(d["height"] == 0.0);
  CHECK(d["velocity"] == 2.0);
}

TEST_CASE("Selector passes the elements that it names, in their order") {
  const BlockObject object = create("Selector", {{"width", 3.0}, {"indices", Numbers{3.0, 1.0, 3.0}}});
  const Specification& spec = *object.specification;
  REQUIRE(spec.passed.size() == 3);
  for (const auto& [output, input] : {std::pair{0, 2}, {1, 0}, {2, 2}}) {
    CHECK(spec.passed[output].input == spec.port("u")->slots[input]);
    CHECK(spec.passed[output].output == spec.port("y")->slots[output]);
  }
}

}  // namespace flyball::test
