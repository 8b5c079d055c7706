#include <cmath>

#include "tests/systems/blocks.h"
#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

TEST_CASE("S17: a relation that is exactly zero changes no bit") {
  // 0, 1 (the limit), 2, 1, 0.5: the bit keeps its side on the limit, from below and from above.
  Run run(R"(
flyball = 1
[blocks]
s1 = { type = "Step", time = 1.0 }
s2 = { type = "Step", time = 2.0 }
s3 = { type = "Step", time = 3.0 }
s4 = { type = "Step", time = 4.0, after = 0.5 }
sum = { type = "Sum", signs = "++--" }
limit = { type = "Saturation", upper = 1.0 }
x = { type = "Integrator" }
[diagram]
wires = ["s1 -> sum.u1", "s2 -> sum.u2", "s3 -> sum.u3", "s4 -> sum.u4", "sum -> limit -> x"]
[simulation]
stop = 5
)");
  const bool on_after[] = {false, false, true, true, false};
  for (int second = 0; second < 5; ++second) {
    do {
      run.advance();
    } while (run.time() < second + 0.5);
    INFO("after " << second << " s");
    CHECK(run.on("limit.above") == on_after[second]);
    CHECK((run["limit.above"] == 0.0) == (second == 1 || second == 3));
  }
  run.finish();
  CHECK(run.simulator().statistics().events == 0);
}

TEST_CASE(
    "S18: bits settle in sorted order: a cascade in one sweep, a jump through both limits at the right one") {
  Run run(R"(
flyball = 1
[blocks]
jump = { type = "Step", time = 1.0, before = 5.0, after = -5.0 }
first = { type = "Saturation", lower = -2.0, upper = 2.0 }
second = { type = "Saturation", lower = -1.0, upper = 1.0 }
third = { type = "Switch", threshold = 0.0 }
high = { type = "Constant", value = 10.0 }
low = { type = "Constant", value = 20.0 }
sampled = { type = "ZeroOrderHold", sample_time = "1/2 s", offset = "1/4 s" }
held = { type = "Saturation", lower = -1.0, upper = 1.0 }
[diagram]
wires = ["jump -> first -> second -> third.control", "high -> third.u1", "low -> third.u3",
         "jump -> sampled -> held"]
log = ["first", "second", "third", "held"]
[simulation]
stop = 2
log_interval = "1/2 s"
)",
          {true, EventRows::none});
  run.finish();
  CHECK(run.column("first") == std::vector<double>{2, 2, -2, -2, -2});
  CHECK(run.column("second") == std::vector<double>{1, 1, -1, -1, -1});
  CHECK(run.column("third") == std::vector<double>{10, 10, 20, 20, 20});
  // The hold shows 0 until 0.25 s, 5 until 1.25 s, then -5.
  CHECK(run.column("held") == std::vector<double>{0, 1, 1, -1, -1});
  CHECK(run.simulator().statistics().events == 0);
}

TEST_CASE("S18: two series saturations that reach their limits at once") {
  for (const std::string method : {"dp5", "adams", "bdf"}) {
    INFO(method);
    Run run(R"(
flyball = 1
[blocks]
sine = { type = "SineWave", amplitude = 2.0 }
lag = { type = "Integrator", initial = -2.0 }
first = { type = "Saturation" }
second = { type = "Saturation" }
x = { type = "Integrator" }
[diagram]
wires = ["sine -> lag -> first -> second -> x"]
log = ["lag", "second"]
[simulation]
stop = 20
solver = { method = ")" +
            method + R"(" }
)");
    run.finish();
    const std::vector<double> u = run.column("lag"), y = run.column("second");
    // At a root u passes the limit by rounding; elsewhere the output is the clamped input, bit for bit.
    for (std::size_t k = 0; k < u.size(); ++k) CHECK(std::fabs(y[k] - std::clamp(u[k], -1.0, 1.0)) < 1e-13);
    // -2 cos t passes -1 and 1 twice a turn; the second block may settle with the first or an instant later.
    CHECK(run.simulator().statistics().events >= 13);
    CHECK(run.simulator().statistics().events <= 2 * 13);
  }
}

TEST_CASE("S19: a located relation keeps the side crossed to") {
  Run run(R"(
flyball = 1
[blocks]
sine = { type = "SineWave" }
size = { type = "Abs" }
x = { type = "Integrator" }
[diagram]
wires = ["sine -> size -> x"]
[simulation]
stop = 100
)");
  long events = 0;
  while (run.advance()) {
    if (run.simulator().statistics().events == std::exchange(events, run.simulator().statistics().events))
      continue;
    // sin falls through zero at odd multiples of pi.
    CHECK(run.on("size.negative") == (std::lround(run.time() / M_PI) % 2 == 1));
  }
  CHECK(events == 31);
  // The integral of |sin| over 31 half waves and the rest; atol and rtol accumulate over the run.
  const double exact = 62.0 + 1.0 - std::cos(100.0 - 31.0 * M_PI);
  CHECK(std::fabs(run["x.x"] - exact) < 10.0 * (1e-8 + 1e-6 * exact));
}

TEST_CASE("S19: when a handler moves the value, the value decides") {
  DiagramBuilder diagram;
  diagram.add<Lift>("lift");
  diagram.log("lift.y");
  diagram.simulation.stop = 10.5;
  Run run(diagram.build());
  double before = 1.0;
  int landings = 0;
  while (run.advance()) {
    if (run["lift.h"] > before) {
      ++landings;
      CHECK_FALSE(run.on("lift.underground"));
      CHECK(run["lift.y"] == 0.0);
    }
    before = run["lift.h"];
  }
  CHECK(landings == 10);
}

TEST_CASE("S20: a ball that bounces is armed for the next bounce, a thousand times") {
  const double gravity = 9.81, fall = std::sqrt(2.0 / gravity), speed = gravity * fall;
  // The step of dp5 is exact on a parabola, whatever the tolerance: only rounding remains. A multistep method
  // may lose one tolerance of the speed a bounce; after n bounces the flight times have drifted by the sum.
  const double drift = 1001.0 * 1001.0 * 1e-10 * speed / gravity;
  for (const auto& [method, allowed] :
       {std::pair("dp5", 1e-7), std::pair("adams", drift), std::pair("bdf", drift)}) {
    INFO(method);
    Run run(R"(
flyball = 1
[blocks]
ball = { type = "BouncingBall", restitution = 1.0 }
[diagram]
log = ["ball.velocity"]
[simulation]
stop = 904
solver = { method = ")" +
            std::string(method) + R"(", rtol = 1e-10, atol = 1e-12, max_step = 0.3 }
log_interval = 100
)");
    run.finish();
    const std::vector<double> t = run.times(), w = run.column("ball.velocity");
    int bounces = 0;
    double worst = 0.0;
    for (std::size_t k = 1; k < t.size(); ++k) {
      if (w[k] > 0.0 && w[k - 1] < 0.0 && t[k] == t[k - 1]) {
        worst = std::max(worst, std::fabs(t[k] - fall * (2 * bounces + 1)));
        ++bounces;
      }
    }
    CHECK(bounces == 1001);
    CHECK(worst < allowed);
  }
}
