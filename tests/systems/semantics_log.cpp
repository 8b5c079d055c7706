#include <cmath>

#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

TEST_CASE("S24: rows stand at the asked times exactly, whatever the steps were") {
  for (const std::string method : {"dp5", "rk4", "adams", "bdf"}) {
    INFO(method);
    Run run(R"(
flyball = 1
[blocks]
v = { type = "Integrator" }
x = { type = "Integrator", initial = 1.0 }
back = { type = "Gain", gain = -1.0 }
[diagram]
wires = ["v -> x -> back -> v"]
log = ["x"]
[simulation]
stop = 10
solver = { method = ")" +
            method + R"(", rtol = 1e-9, atol = 1e-9, step = 0.01 }
log_interval = "1/7 s"
)");
    run.finish();
    const std::vector<double> t = run.times(), x = run.column("x");
    REQUIRE(t.size() == 71);
    double worst = 0.0;
    for (std::size_t k = 0; k < t.size(); ++k) {
      REQUIRE(t[k] == static_cast<double>(k) / 7.0);
      worst = std::max(worst, std::fabs(x[k] - std::cos(t[k])));
    }
    // Some hundred steps of 1e-9 (|x| <= 1, so rtol and atol add) for the variable methods; for RK4 with
    // h = 0.01, t h^4/120 = 8e-10 of the steps and h^4/384 = 3e-11 of cubic interpolation.
    CHECK(worst < 2e-7);
  }
}

namespace {

const std::string jumping = R"(
flyball = 1
[blocks]
step = { type = "Step", time = 0.5, before = 2.0, after = 3.0 }
x = { type = "Integrator" }
ball = { type = "BouncingBall", gravity = 2.0, initial_height = 0.36, restitution = 0.5 }
[diagram]
wires = ["step -> x"]
log = ["step", "x", "ball.velocity"]
[simulation]
stop = 1
log_interval = "1/4 s"
)";

}  // namespace

TEST_CASE("S25: a jump has two rows of the same time, and never a slope") {
  Run run(jumping);
  run.finish();
  const std::vector<double> t = run.times(), step = run.column("step"), w = run.column("ball.velocity");
  REQUIRE(t.size() == 5 + 1 + 2);
  // The asked time 0.5 is a jump, and the bounce at 0.6 is another: h = 0.36 - t^2.
  CHECK(std::vector<double>(t.begin(), t.begin() + 4) == std::vector<double>{0.0, 0.25, 0.5, 0.5});
  CHECK(std::vector<double>(step.begin(), step.begin() + 4) == std::vector<double>{2.0, 2.0, 2.0, 3.0});
  CHECK(t[5] == t[4]);
  CHECK(std::fabs(t[4] - 0.6) < 1e-14);
  // Velocity -2 t, exact to rounding.
  CHECK(std::fabs(w[4] + 1.2) < 1e-13);
  CHECK(std::fabs(w[5] - 0.6) < 1e-13);
  CHECK(t.back() == 1.0);
}

TEST_CASE("S25: event rows after a jump only, and none") {
  Run after(jumping, {true, EventRows::after});
  after.finish();
  const std::vector<double> t = after.times();
  CHECK(std::ranges::adjacent_find(t, std::greater_equal()) == t.end());
  CHECK(after.logged("step", 0.5) == 3.0);
  CHECK(t.size() == 5 + 1);

  Run none(jumping, {true, EventRows::none});
  none.finish();
  CHECK(none.times().size() == 5);
  CHECK(none.logged("step", 0.5) == 3.0);
  CHECK(none.logged("x", 1.0) == after.logged("x", 1.0));
}
