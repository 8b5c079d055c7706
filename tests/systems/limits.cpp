#include <cmath>

#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

TEST_CASE("A limited integrator rests on its limits and leaves them when its input turns") {
  for (const std::string method : {"dp5", "adams", "bdf"}) {
    INFO(method);
    Run run(R"toml(
flyball = 1
[blocks]
cosine = { type = "SineWave", phase = "90 deg" }
x = { type = "Integrator", lower = -0.5, upper = 0.5 }
[diagram]
wires = ["cosine -> x"]
log = ["x"]
[simulation]
stop = 30
log_interval = "1/100 s"
solver = { method = ")toml" +
                method + "\", rtol = 1e-9, atol = 1e-9 }\n",
            {true, EventRows::none});
    run.finish();
    double worst = 0.0;
    for (int k = 0; k <= 3000; ++k) {
      const double t = k / 100.0, turn = std::fmod(t, 2.0 * M_PI);
      // sin t up to 0.5; then, from each extremum of sin t on, as far below or above the limit as sin t is
      // from it.
      double exact = turn < 0.5 * M_PI ? 0.5 : std::max(-0.5, 0.5 + std::sin(t) - 1.0);
      if (turn >= 1.5 * M_PI) exact = std::min(0.5, -0.5 + std::sin(t) + 1.0);
      if (t < 0.5 * M_PI) exact = std::min(std::sin(t), 0.5);
      worst = std::max(worst, std::fabs(run.logged("x", t) - exact));
    }
    // A limit forgets all errors: what remains is of the some 50 steps of one passage, each 1e-9 (1 + |x|).
    CHECK(worst < 5e-8);
  }
}

TEST_CASE("An integrator that starts beyond its limit is set onto it") {
  Run run(R"toml(
flyball = 1
[blocks]
one = { type = "Constant" }
x = { type = "Integrator", initial = 7.0, upper = 2.0 }
[diagram]
wires = ["one -> x"]
log = ["x"]
[simulation]
stop = 1
)toml");
  run.finish();
  for (const double x : run.column("x")) CHECK(x == 2.0);
}

TEST_CASE("An integrator that is reset by its own output is a sawtooth") {
  Run run(R"toml(
flyball = 1
[blocks]
one = { type = "Constant" }
x = { type = "Integrator", reset = "rising", threshold = 1.0 }
[diagram]
wires = ["one -> x.u", "x -> x.reset"]
log = ["x"]
[simulation]
stop = 100.5
log_interval = "1/4 s"
)toml",
          {true, EventRows::none});
  run.finish();
  CHECK(run.simulator().statistics().events == 100);
  // Each tooth begins at most 4 units in the last place of the time late: 1e-13 at 100 s, and they add up.
  CHECK(std::fabs(run["x.x"] - 0.5) < 100 * 1e-13);
  for (int k = 0; k < 100; ++k) CHECK(std::fabs(run.logged("x", k + 0.75) - 0.75) < 100 * 1e-13);
}
