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

TEST_CASE("RepeatingSequence repeats its pieces, exactly at every period") {
  Device d("RepeatingSequence", {{"times", Numbers{0.5, 0.6, 0.8}}, {"values", Numbers{1.0, 3.0, -1.0}}});
  d.time(0.2);
  CHECK(d.update()["y"] == 1.0);
  for (int period = 0; period < 1000; ++period) {
    const double shift = period * (0.8 - 0.5);
    d.update();
    REQUIRE(d["kink"] == (period == 0 ? 0.5 : 0.5 + shift));
    d.time(d["kink"]);
    d.handle(Phase::time);
    REQUIRE(d.update()["y"] == 1.0);
    REQUIRE(d["kink"] == 0.6 + shift);
    d.time(0.55 + shift);
    // The slope 20 amplifies the rounding of times of at most 300 s.
    REQUIRE(std::fabs(d.update()["y"] - 2.0) < 20 * 4 * 300 * 0x1p-53);
    d.time(d["kink"]);
    d.handle(Phase::time);
    REQUIRE(d.update()["y"] == 3.0);
  }
}

TEST_CASE("RepeatingSequence can hold its values") {
  Device d("RepeatingSequence", {{"times", Numbers{0.0, 1.0, 2.0}},
                                 {"values", Numbers{5.0, 7.0, 0.0}},
                                 {"interpolation", std::string("hold")}});
  std::vector<double> seen;
  for (int k = 0; k < 4; ++k) {
    d.time(d.update()["kink"]);
    CHECK(d["kink"] == k);
    d.handle(Phase::time);
    d.time(k + 0.5);
    seen.push_back(d.update()["y"]);
  }
  CHECK(seen == std::vector{5.0, 7.0, 5.0, 7.0});
}

namespace {

/// The values of a FromFile over these rows at 0, 1/4, 1/2, … up to 5.
std::vector<double> played(Keys keys, std::vector<double> times, std::vector<double> values) {
  keys["file"] = std::make_shared<const TimeSeries>(TimeSeries{"m", std::move(times), std::move(values)});
  Device d("FromFile", keys);
  std::vector<double> y;
  for (double t = 0.0; t <= 5.0; t += 0.25) {
    d.time(t);
    while (d.update()["kink"] <= t) d.handle(Phase::time);
    y.push_back(d["y"]);
  }
  return y;
}

}  // namespace

TEST_CASE("FromFile interpolates between its rows, jumps at double ones, and goes on as asked for") {
  const std::vector<double> times{1.0, 2.0, 2.0, 3.0, 4.0}, values{1.0, 3.0, -1.0, -1.0, 1.0};
  const auto at = [](double t, double before, double after) {
    if (t < 1.0) return before;
    if (t < 2.0) return 1.0 + 2.0 * (t - 1.0);
    if (t < 3.0) return -1.0;
    return t < 4.0 ? -1.0 + 2.0 * (t - 3.0) : after;
  };
  using namespace std::string_literals;
  const auto hold = played({}, times, values),
             line = played({{"before", "linear"s}, {"after", "linear"s}}, times, values),
             zero = played({{"before", "zero"s}, {"after", "zero"s}}, times, values),
             steps = played({{"interpolation", "hold"s}}, times, values);
  for (int k = 0; k <= 20; ++k) {
    const double t = 0.25 * k;
    INFO("t = " << t);
    CHECK(hold[k] == at(t, 1.0, 1.0));
    CHECK(line[k] == at(t, 1.0 + 2.0 * (t - 1.0), -1.0 + 2.0 * (t - 3.0)));
    CHECK(zero[k] == at(t, 0.0, 0.0));
    CHECK(steps[k] == (t < 2.0 ? 1.0 : t < 4.0 ? -1.0 : 1.0));
  }
}

TEST_CASE("FromFile begins in the middle of rows before time 0, and one row is a constant") {
  const auto y = played({}, {-3.0, -1.0, 3.0}, {9.0, 0.0, 8.0});
  for (int k = 0; k <= 12; ++k) CHECK(y[k] == 2.0 * (0.25 * k + 1.0));
  CHECK(y[20] == 8.0);
  for (const double constant : played({{"after", std::string("linear")}}, {2.0}, {4.0}))
    CHECK(constant == 4.0);
}

}  // namespace flyball::test
