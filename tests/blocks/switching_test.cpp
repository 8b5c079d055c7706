// Nonlinear, routing, sampled, hybrid and robot blocks.
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

TEST_CASE("DifferentialDrive turns wheel speeds into motion") {
  Device d("DifferentialDrive", {{"wheel_diameter", 0.04}, {"track_width", 0.054}, {"initial_theta", 0.5}});
  // v = (dw/4)(right + left), omega = dw/(2 wT) (right - left); the last of ten printed digits is rounded.
  const double printed = 0.5e-9;
  struct Vector {
    double right, left, v, omega;
  };
  for (const Vector& x : {Vector{3.05845, 1.04155, 0.041, 0.747}, Vector{6.5, -6.5, 0.0, 4.814814815},
                          Vector{6.5, 0.0, 0.065, 2.407407407}, Vector{2.405, 1.595, 0.04, 0.3}}) {
    d["right"] = x.right, d["left"] = x.left;
    d.update();
    CHECK(std::fabs(d["v"] - x.v) <= printed);
    CHECK(std::fabs(d["omega"] - x.omega) <= printed);
  }
}

TEST_CASE("DifferentialDrive moves along its heading, counter-clockwise when the right wheel is faster") {
  Device d("DifferentialDrive",
           {{"wheel_diameter", 0.1}, {"track_width", 0.25}, {"initial_x", 2.0}, {"initial_theta", 0.5}});
  CHECK(d["pose"] == 2.0);
  CHECK(d.bench().spec().port("pose")->elements == std::vector<std::string>{"x", "y", "theta"});
  d["right"] = 6.0, d["left"] = 4.0;
  d.update();
  // v = 0.25 and omega = 0.4, each with at most three roundings
  const double roundings = 3 * 0x1p-53;
  CHECK(std::fabs(d.rate("x") - 0.25 * std::cos(0.5)) <= roundings);
  CHECK(std::fabs(d.rate("y") - 0.25 * std::sin(0.5)) <= roundings);
  CHECK(std::fabs(d.rate("theta") - 0.4) <= roundings);
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
