#include "tests/blocks/bench.h"
#include "tests/catch.h"

namespace flyball::test {

TEST_CASE("Constant is its value") { CHECK(Device("Constant", {{"value", -3.0}}).update()["y"] == -3.0); }

TEST_CASE("Step jumps once, at its time") {
  Device d("Step", {{"time", 2.0}, {"before", -1.0}, {"after", 4.0}});
  CHECK(d.update()["y"] == -1.0);
  CHECK(d["jump"] == 2.0);
  // Time alone changes nothing: only the alarm does.
  d.time(3.0);
  CHECK(d.update()["y"] == -1.0);
  d.handle(Phase::time);
  CHECK(d.update()["y"] == 4.0);
  CHECK(d["jump"] == never);
}

TEST_CASE("SineWave follows its closed form") {
  Device d("SineWave", {{"amplitude", 2.0}, {"frequency", 3.0}, {"phase", 0.5}, {"bias", -1.0}});
  d.time(0.25);
  CHECK(d.update()["y"] == 2.0 * std::sin(opaque(3.0 * 0.25 + 0.5)) - 1.0);
}

TEST_CASE("Clock is the time") {
  Device d("Clock");
  d.time(1.5);
  CHECK(d.update()["y"] == 1.5);
}

TEST_CASE("PulseGenerator starts pulse k at delay + k*period, exactly") {
  Device d("PulseGenerator", {{"amplitude", 5.0}, {"period", 0.1}, {"duty", 0.3}, {"delay", 0.7}});
  double last = -1.0;
  for (int k = 0; k < 10000; ++k) {
    d.update();
    REQUIRE(d["y"] == 0.0);
    REQUIRE(d["edge"] == 0.7 + k * 0.1);
    REQUIRE(d["edge"] > last);
    last = d["edge"];
    d.time(last);
    d.handle(Phase::time);
    d.update();
    REQUIRE(d["y"] == 5.0);
    REQUIRE(d["edge"] == 0.7 + (k + 0.3) * 0.1);
    REQUIRE(d["edge"] > last);
    last = d["edge"];
    d.handle(Phase::time);
  }
}

TEST_CASE("PulseGenerator without delay is high from time 0 on, after one alarm") {
  Device d("PulseGenerator", {{"period", 2.0}, {"duty", 0.25}});
  d.update();
  CHECK(d["edge"] == 0.0);
  d.handle(Phase::time);
  d.update();
  CHECK(d["y"] == 1.0);
  CHECK(d["edge"] == 0.5);
}

TEST_CASE("Ramp rises from its alarm on, not from its time on") {
  Device d("Ramp", {{"slope", 3.0}, {"start", 2.0}, {"initial", -1.0}});
  CHECK(d.update()["y"] == -1.0);
  CHECK(d["begin"] == 2.0);
  d.time(4.0);
  CHECK(d.update()["y"] == -1.0);
  d.handle(Phase::time);
  CHECK(d.update()["y"] == 5.0);
  CHECK(d["begin"] == never);
}

TEST_CASE("Chirp has the frequencies that it names") {
  Device d(
      "Chirp",
      {{"amplitude", 2.0}, {"initial_frequency", 3.0}, {"target_time", 4.0}, {"target_frequency", 11.0}});
  const auto y = [&](double t) {
    d.time(t);
    return d.update()["y"];
  };
  // The frequency is 3 + 2 t, its integral 3 t + t^2.
  for (const double t : {0.0, 0.5, 4.0, 6.0}) {
    INFO("t = " << t);
    // Four roundings in a phase of at most 54.
    CHECK(std::fabs(y(t) - 2.0 * std::sin(opaque(3.0 * t + t * t))) <= 2.0 * 4 * 54 * 0x1p-53);
  }
}

}  // namespace flyball::test
