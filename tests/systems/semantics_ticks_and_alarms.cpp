#include <cmath>
#include <set>

#include "tests/systems/blocks.h"
#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

TEST_CASE("S21: ten million hits of 0.1 s do not drift") {
  DiagramBuilder diagram;
  diagram.add<HitCounter>("hits", {{"sample_time", *Rational::fraction(1, 10)}, {"hits_per_second", 10.0}});
  diagram.simulation.stop = 1e6;
  Run run(diagram.build(), {false});
  run.finish();
  CHECK(run.time() == 1e6);
  CHECK(run["hits.count"] == 1e7 + 1.0);
  // Each hit was at k/10, rounded once: 0.1 added up ten million times is off by 2e-4.
  CHECK(run["hits.late"] == 0.0);
}

TEST_CASE("S21: 1/2, 1/3 and 3/10 s together are on one base tick") {
  Run run(R"(
flyball = 1
[blocks]
clock = { type = "Clock" }
half = { type = "ZeroOrderHold", sample_time = "1/2 s" }
third = { type = "ZeroOrderHold", sample_time = "1/3 s" }
tenths = { type = "ZeroOrderHold", sample_time = "3/10 s" }
[diagram]
wires = ["clock -> half", "clock -> third", "clock -> tenths"]
[simulation]
stop = 6
)");
  CHECK(run.plan().base_tick == *Rational::fraction(1, 30));
  std::set<double> ticks;
  for (int k = 0; k <= 6 * 30; ++k) {
    if (k % 15 == 0 || k % 10 == 0 || k % 9 == 0) ticks.insert(k / 30.0);
  }
  for (bool more = true; more;) {
    const long hits = run.simulator().statistics().hits;
    more = run.advance();
    if (run.simulator().statistics().hits == hits) continue;
    // The first call of `advance` also carries out the instant at 0.
    if (hits == 0) ticks.erase(0.0);
    if (run.simulator().statistics().hits - hits > (hits == 0 ? 1 : 0)) {
      REQUIRE(run.time() == *ticks.begin());
      ticks.erase(ticks.begin());
    }
  }
  CHECK(ticks.empty());
  // Each block showed the time of its last hit.
  CHECK(run["half.y"] == 6.0);
  CHECK(run["third.y"] == 6.0);
  CHECK(run["tenths.y"] == 6.0);
}

TEST_CASE("S22: an alarm that is not after the present names its block") {
  for (const double again : {0.5, 1.0}) {
    DiagramBuilder diagram;
    diagram.add<BackwardAlarm>("clock", {{"again", again}});
    diagram.simulation.stop = 2.0;
    Run run(diagram.build());
    const SimulationError error = run.stop();
    CHECK(error.kind() == SimulationError::Kind::alarm);
    CHECK(error.time() == 1.0);
    CHECK(error.what() == "clock.ring asks to be woken at t = " + std::string(again == 1.0 ? "1" : "0.5") +
                              " s, which is not after t = 1 s");
  }
}

TEST_CASE("S23: a step that ends on a jump does not see the far side of it") {
  DiagramBuilder diagram;
  diagram.add("PulseGenerator", "pulse", {{"period", 2.0}, {"duty", 0.5}, {"delay", 1.0}});
  diagram.add<Spy>("spy");
  diagram.wire("pulse.y", "spy.u");
  diagram.simulation.stop = 6.5;
  Run run(diagram.build());
  std::vector<std::pair<double, double>> seen;
  Spy::seen = [&](double t, double u) { seen.emplace_back(t, u); };
  run.finish();
  Spy::seen = nullptr;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const auto [t, u] = seen[k];
    const bool high = t >= 1.0 && std::fmod(t - 1.0, 2.0) < 1.0;
    const bool jump = t > 0.0 && t == std::floor(t);
    // On a jump, the evaluations of the step are before it; the one that begins the next step is behind.
    if (!jump) CHECK(u == (high ? 1.0 : 0.0));
  }
  // Pulses in [1, 2], [3, 4] and [5, 6]. Piecewise linear: exact but for the rounding of the sums.
  CHECK(std::fabs(run["spy.x"] - 3.0) < 1e-13);
  CHECK(run.simulator().statistics().stepper.rejected == 0);
}
