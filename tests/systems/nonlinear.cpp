// Nonlinear blocks in a run, against closed forms.
#include <algorithm>
#include <cmath>

#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

namespace {

/// u(t) of a formula of time through one block.
Run through(const std::string& formula, const std::string& block, const std::string& stop) {
  return Run(R"toml(
flyball = 1
[blocks]
time = { type = "Clock" }
u = { type = "Expression", inputs = ["t"], formula = ")toml" +
             formula + R"toml(" }
block = )toml" +
             block + R"toml(
[diagram]
wires = ["time -> u -> block"]
log = ["u", "block.y"]
[simulation]
stop = )toml" +
             stop + R"toml(
log_interval = 0.1
solver = { method = "dp5", rtol = 1e-10, atol = 1e-12, max_step = 0.05 }
)toml");
}

}  // namespace

TEST_CASE("Quantizer of a ramp: each step at its time, up and down") {
  Run run = through("if(t < 2, t, 4 - t)", "{ type = \"Quantizer\", interval = 0.3 }", "4");
  run.finish();
  const std::vector<double> t = run.times(), y = run.column("block.y");
  int changes = 0;
  for (std::size_t k = 1; k < t.size(); ++k) {
    if (y[k] == y[k - 1]) continue;
    REQUIRE(t[k] == t[k - 1]);
    // Up through 0.15, 0.45, …, 1.95, then down in the mirror.
    const double exact = changes < 7 ? 0.15 + 0.3 * changes : 4.0 - (0.15 + 0.3 * (13 - changes));
    // Roots are bracketed to 4 units in the last place of at most 4.
    CHECK(std::fabs(t[k] - exact) <= 4 * 4 * 0x1p-52);
    CHECK(std::fabs(y[k] - y[k - 1]) == Approx(0.3));
    ++changes;
  }
  CHECK(changes == 14);
}

TEST_CASE("Quantizer: a sampled block reads the new level in the instant of the jump, and at the start") {
  Run run(R"toml(
flyball = 1
[blocks]
jump = { type = "Step", time = 1.0, before = 0.8, after = 5.3 }
sampled = { type = "ZeroOrderHold", sample_time = 1.0 }
rounded = { type = "Quantizer", interval = 1.0 }
hold = { type = "ZeroOrderHold", sample_time = 1.0 }
ramp = { type = "Integrator" }
[diagram]
wires = ["jump -> sampled -> rounded -> hold", "hold -> ramp"]
log = ["hold"]
[simulation]
stop = 3.0
log_interval = 0.5
)toml");
  run.finish();
  CHECK(run.logged("hold", 0.5) == 1.0);
  // The step comes with the commit of t = 1, so that the next hit is the first to see it.
  CHECK(run.logged("hold", 1.5) == 1.0);
  CHECK(run.logged("hold", 2.0) == 5.0);
}

TEST_CASE("RateLimiter of a jump: a ramp, then an exponential from where the rate is no longer the limit") {
  Run run = through("3 + 0*t", "{ type = \"RateLimiter\", rising = 2.0, tau = 0.13 }", "3");
  run.finish();
  const double tau = 0.13, rate = 2.0, knee = (3.0 - rate * tau) / rate;
  for (int k = 1; k <= 30; ++k) {
    const double t = k / 10.0;
    const double exact = t < knee ? rate * t : 3.0 - rate * tau * std::exp(-(t - knee) / tau);
    // The tolerance of a run of values up to 3.
    CHECK(std::fabs(run.logged("block.y", t) - exact) <= 10 * (1e-12 + 1e-10 * 3.0));
  }
}

TEST_CASE("Backlash of a sine: behind by half of the play, and at rest after each turn") {
  Run run = through("sin(t)", "{ type = \"Backlash\", width = 0.4, tau = 1e-4 }", "6");
  run.finish();
  for (int k = 1; k <= 60; ++k) {
    const double t = k / 10.0, u = std::sin(t);
    // Pushed up from 0.2 to the crest at pi/2, at rest until the sine is 0.4 lower, pushed down to the
    // trough, at rest, and pushed up again.
    const double up = M_PI / 2, down = M_PI - std::asin(0.6), rest = 3 * M_PI / 2;
    const double exact = u < 0.2 && t < up ? 0.0
                         : t < up          ? u - 0.2
                         : t < down        ? 0.8
                         : t < rest        ? u + 0.2
                                           : std::max(-0.8, u - 0.2);
    // y is late by tau at a rate of at most 1, and as much of the crest is missed.
    INFO("t = " << t);
    CHECK(std::fabs(run.logged("block.y", t) - exact) <= 1.1e-4);
  }
}

TEST_CASE("HitCrossing counts the passages of its direction and marks each by a pulse") {
  for (const auto& [direction, hits] : {std::pair{"rising", 3.0}, {"falling", 3.0}, {"either", 6.0}}) {
    INFO(direction);
    Run run = through(
        "cos(2*pi*t) - 0.5",
        "{ type = \"HitCrossing\", width = 0.05, direction = \"" + std::string(direction) + "\" }", "3");
    run.finish();
    // cos = 1/2 falling at 1/6, rising at 5/6; the signal begins above, which is no hit.
    CHECK(run["block.count"] == hits);
    const std::vector<double> t = run.times(), y = run.column("block.y");
    std::vector<double> starts, lengths;
    for (std::size_t k = 1; k < t.size(); ++k) {
      if (y[k] > y[k - 1]) starts.push_back(t[k]);
      if (y[k] < y[k - 1]) lengths.push_back(t[k] - starts.back());
    }
    REQUIRE(starts.size() == hits);
    // The slope is 5.4; the cosine of up to 19 rounds its argument to 2e-15.
    const double phase = direction == std::string("rising") ? 5.0 / 6.0 : 1.0 / 6.0;
    CHECK(std::fabs(starts[0] - phase) < 1e-14);
    CHECK(std::fabs(starts.back() - (direction == std::string("falling") ? 13.0 / 6.0 : 17.0 / 6.0)) < 1e-14);
    for (const double length : lengths) CHECK(std::fabs(length - 0.05) < 1e-15 * 4);
  }
}

TEST_CASE("Comparison and logic of continuous signals switch where they cross") {
  Run run(R"toml(
flyball = 1
[blocks]
time = { type = "Clock" }
one = { type = "Constant", value = 1.0 }
two = { type = "Constant", value = 2.0 }
from = { type = "RelationalOperator", operator = ">=" }
to = { type = "RelationalOperator", operator = ">" }
inside = { type = "LogicalOperator", operator = "XOR" }
x = { type = "Integrator" }
[diagram]
wires = ["time -> from.u1, to.u1", "one -> from.u2", "two -> to.u2", "from -> inside.u1", "to -> inside.u2", "inside -> x"]
log = ["inside"]
[simulation]
stop = 3.0
log_interval = 3.0
)toml");
  run.finish();
  // The rows at 0, 1-, 1+, 2-, 2+ and 3.
  CHECK(run.column("inside") == std::vector<double>{0.0, 0.0, 1.0, 1.0, 0.0, 0.0});
  // Roots are bracketed to 4 units in the last place.
  CHECK(std::fabs(run["x.x"] - 1.0) <= 8 * 0x1p-51);
}

TEST_CASE("The kinks of a table cost no accuracy: the order through them is that of the method") {
  // x' = f(t), f a triangle wave of t with kinks at 0.37, 1.21 and 2.03: quadratic pieces, exact for any
  // method of second order.
  for (const std::string table : {"LookupTable1D", "LookupTable2D"}) {
    const std::string second = table == "LookupTable2D" ? "2" : "";
    Run run(std::string(R"toml(
flyball = 1
[blocks]
time = { type = "Clock" }
)toml") +
            (second.empty() ? R"toml(
f = { type = "LookupTable1D", breakpoints = [0.0, 0.37, 1.21, 2.03, 3.0], table = [0.0, 1.0, -1.0, 2.0, 0.0] })toml"
                            : R"toml(
zero = { type = "Constant", value = 0.0 }
f = { type = "LookupTable2D", breakpoints1 = [0.0, 0.37, 1.21, 2.03, 3.0], breakpoints2 = [-1.0, 1.0], table = [[0.0, 0.0], [1.0, 1.0], [-1.0, -1.0], [2.0, 2.0], [0.0, 0.0]] })toml") +
            R"toml(
x = { type = "Integrator" }
[diagram]
wires = ["time -> f)toml" +
            (second.empty() ? "" : ".u1\", \"zero -> f.u2") + R"toml(", "f -> x"]
[simulation]
stop = 3
solver = { method = "rk4", step = 0.25 }
)toml");
    run.finish();
    const double exact = (0.37 * 1.0 + 0.82 * 1.0 + 0.97 * 2.0) / 2.0;
    // Roots are bracketed to 4 units in the last place; a smeared kink would cost 0.25^2 * 6/8 = 0.05.
    CHECK(std::fabs(run["x.x"] - exact) <= 1e-14);
  }
}
