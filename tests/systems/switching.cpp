#include <cmath>

#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

TEST_CASE("Sine, relay without hysteresis, integrator: every switch is found, at its time") {
  for (const std::string method : {"dp5", "adams", "bdf"}) {
    INFO(method);
    Run run(R"toml(
flyball = 1
[blocks]
sine = { type = "SineWave", frequency = "2*pi*5" }
relay = { type = "Relay", switch_on = 0.0, switch_off = 0.0, on = 1.0, off = -1.0 }
x = { type = "Integrator" }
[diagram]
wires = ["sine -> relay -> x"]
log = ["relay", "x"]
[simulation]
stop = 20.05
solver = { method = ")toml" +
            method + R"toml(", max_step = 0.04 }
log_interval = 20
)toml");
    run.finish();
    const std::vector<double> t = run.times(), y = run.column("relay");
    int switches = 0;
    double worst = 0.0;
    for (std::size_t k = 1; k < t.size(); ++k) {
      if (y[k] == y[k - 1]) continue;
      REQUIRE(t[k] == t[k - 1]);
      worst = std::max(worst, std::fabs(t[k] - 0.1 * switches));
      ++switches;
    }
    // Rising at 0, 0.2, …, falling at 0.1, 0.3, …: 0 to 20 s in steps of 0.1 s.
    CHECK(switches == 201);
    // The sine is evaluated at the time itself; its argument of 2 pi 100 is rounded to 1e-13, the slope
    // is 31.
    CHECK(worst < 2e-14);
    // A triangle of height 0.1 that ends halfway up, within the tolerance of 201 restarts.
    CHECK(std::fabs(run["x.x"] - 0.05) < 201 * 1e-8);
  }
}

TEST_CASE("Relay with hysteresis under a triangle switches late by the hysteresis") {
  // x' = +-1 between -0.25 and 0.25: a limit cycle of period 1, begun at 0.
  Run run(R"toml(
flyball = 1
[blocks]
x = { type = "Integrator" }
back = { type = "Gain", gain = -1.0 }
relay = { type = "Relay", switch_on = 0.25, switch_off = -0.25, on = 1.0, off = -1.0 }
[diagram]
wires = ["relay -> x -> back -> relay"]
log = ["relay"]
[simulation]
stop = 50
log_interval = 50
)toml");
  run.finish();
  const std::vector<double> t = run.times(), y = run.column("relay");
  int switches = 0;
  for (std::size_t k = 1; k < t.size(); ++k) {
    if (y[k] == y[k - 1]) continue;
    // Each root is bracketed to 4 units in the last place of at most 50, and the errors add.
    CHECK(std::fabs(t[k] - (0.25 + 0.5 * switches)) < 100 * 4 * 1e-14);
    ++switches;
  }
  CHECK(switches == 100);
}
