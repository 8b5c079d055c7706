// Loops against closed forms: in rates, in steps of high order, with Jacobians, of many members.
#include <cmath>

#include "solvers/plan_system.h"
#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

namespace {

/// x' = z where z = -x - z^3, from z = 1; then ln z + 3/2 z^2 + t = 3/2.
std::string cubic(const std::string& solver) {
  return R"toml(
flyball = 1
[blocks]
x = { type = "Integrator", initial = -2.0 }
z = { type = "Expression", inputs = ["x", "w"], formula = "-x - w^3" }
[diagram]
wires = ["x -> z.x", "z -> z.w", "z -> x"]
log = ["z"]
[simulation]
stop = 1
solver = )toml" +
         solver + "\n";
}

double cubic_error(double t, double z) { return std::fabs(std::log(z) + 1.5 * z * z + t - 1.5); }

/// The Jacobian of the rates at the present point, by columns over its pattern, and by central differences.
void check_jacobian(Run& run, double tolerance) {
  Workspace<double> workspace = run.simulator().workspace();
  PlanSystem system(run.plan(), workspace);
  const int n = system.size();
  const Sparsity& pattern = system.pattern();
  const auto begin = workspace.values.begin() + run.plan().layout.first_state;
  std::vector<double> x(begin, begin + n), exact(pattern.row.size()), above(n), below(n);
  const double t = workspace.values[0];
  system.jacobian(t, x.data(), exact.data());
  for (int c = 0; c < n; ++c) {
    const double h = 1e-5, at = x[c];
    x[c] = at + h;
    system.rates(t, x.data(), above.data());
    x[c] = at - h;
    system.rates(t, x.data(), below.data());
    x[c] = at;
    std::vector<double> column(n, 0.0);
    for (int k = pattern.start[c]; k < pattern.start[c + 1]; ++k) column[pattern.row[k]] = exact[k];
    for (int r = 0; r < n; ++r) {
      CHECK(column[r] == Approx((above[r] - below[r]) / (2.0 * h)).margin(tolerance));
    }
  }
}

}  // namespace

TEST_CASE("A linear loop in a rate: every method agrees with the closed form") {
  // z = x - z/2, so x' = -z = -x/1.5.
  for (const std::string method : {"dp5", "rk4", "exact", "adams", "bdf"}) {
    INFO(method);
    Run run(R"toml(
flyball = 1
[blocks]
x = { type = "Integrator", initial = 1.0 }
z = { type = "Sum", signs = "+-" }
half = { type = "Gain", gain = 0.5 }
minus = { type = "Gain", gain = -1.0 }
[diagram]
wires = ["x -> z.u1", "z -> half -> z.u2", "z -> minus -> x"]
log = ["x", "z"]
[simulation]
stop = 2
solver = { rtol = 1e-9, atol = 1e-11, step = "1 ms", method = ")toml" +
            method + "\" }\n");
    run.finish();
    // 1e-9 a step, over at most a few hundred steps; the errors of a step decay.
    CHECK(run.logged("x", 2.0) == Approx(std::exp(-2.0 / 1.5)).epsilon(1e-7));
    CHECK(run.logged("z", 2.0) == Approx(run.logged("x", 2.0) / 1.5).epsilon(1e-14));
  }
}

TEST_CASE("A curved loop in a rate: Dormand-Prince keeps its fifth order") {
  std::vector<double> errors;
  for (const int steps : {10, 20, 40}) {
    Run run(cubic("{ method = \"dp5\", rtol = 1e6, atol = 1e6, max_step = " + std::to_string(1.0 / steps) +
                  " }"));
    run.finish();
    errors.push_back(cubic_error(1.0, run.logged("z", 1.0)));
  }
  for (std::size_t k = 1; k < errors.size(); ++k) {
    const double order = std::log2(errors[k - 1] / errors[k]);
    CHECK(order > 4.5);
    CHECK(order < 6.5);  // the next term of the error still counts at these steps
  }
}

TEST_CASE("A curved loop in a rate: multistep methods agree with the closed form") {
  for (const std::string method : {"adams", "bdf"}) {
    INFO(method);
    Run run(cubic("{ rtol = 1e-9, atol = 1e-11, method = \"" + method + "\" }"));
    run.finish();
    CHECK(cubic_error(1.0, run.logged("z", 1.0)) < 1e-6);  // about 1e-9 a step over a few hundred steps
  }
}

TEST_CASE("S37: the Jacobian of the rates goes through loops") {
  // Two loops, one in the other's reads, of different numbers of tears.
  Run run(R"toml(
flyball = 1
[blocks]
a = { type = "Integrator", initial = 0.7 }
b = { type = "Integrator", initial = -0.4 }
p = { type = "Expression", inputs = ["a", "q"], formula = "a - 0.3*sin(q)" }
q = { type = "Expression", inputs = ["b", "p"], formula = "b*p + 0.2*p" }
r = { type = "Expression", inputs = ["q", "r", "a"], formula = "0.5*cos(r) + q*a" }
rate_b = { type = "Expression", inputs = ["p", "r"], formula = "p*r - 1" }
[diagram]
wires = ["a -> p.a, r.a", "b -> q.b", "p -> q.p, rate_b.p", "q -> p.q, r.q", "r -> r.r, a, rate_b.r", "rate_b -> b"]
log = ["a"]
[simulation]
stop = 0.5
)toml");
  run.finish();
  CHECK(run.plan().pattern.row.size() == 4);
  check_jacobian(run, 1e-9);  // differences over 2e-5: 1e-10 from their curvature, 1e-11 from rounding
}

TEST_CASE("x = cos x") {
  Run run(R"toml(
flyball = 1
[blocks]
x = { type = "Expression", formula = "cos(u)" }
[diagram]
wires = ["x -> x"]
)toml");
  run.finish();
  CHECK(run.logged("x", 10.0) == Approx(0.73908513321516064).epsilon(1e-15));
}

TEST_CASE("An index-1 circuit: a source behind a resistor feeds a capacitor and a diode") {
  // The current of the resistor is that of the diode, Is (exp(v/Vt) - 1) = (E - v)/R with E = sin t, whose
  // exponential takes Newton's method far away from 0.
  Run run(R"toml(
flyball = 1
[parameters]
R = 1000.0
Is = 1e-12
Vt = 0.025
[blocks]
E = { type = "SineWave", amplitude = 5.0 }
v = { type = "Expression", inputs = ["E", "i"], formula = "E - R*i" }
i = { type = "Expression", inputs = ["v"], formula = "Is*(exp(v/Vt) - 1)" }
charge = { type = "Integrator" }
[diagram]
wires = ["E -> v.E", "v -> i -> v.i", "i -> charge"]
log = ["E", "v", "i"]
)toml");
  run.finish();
  const std::vector<double> E = run.column("E"), v = run.column("v"), i = run.column("i");
  for (std::size_t k = 0; k < v.size(); ++k) {
    CHECK(std::fabs(E[k] - 1000.0 * i[k] - v[k]) <= loop_tolerance * std::max(1.0, std::fabs(v[k])));
    // The current answers an error of v with the diode's slope, up to 0.2 A/V.
    CHECK(i[k] == Approx(1e-12 * std::expm1(v[k] / 0.025)).margin(1e-10));
  }
}

TEST_CASE("A loop of a thousand blocks is one tear") {
  std::string blocks, wires;
  for (int k = 1; k <= 1000; ++k) {
    blocks += "g" + std::to_string(k) + " = { type = \"Gain\", gain = " + (k % 2 ? "2.0" : "0.5") + " }\n";
    wires += " -> g" + std::to_string(k);
  }
  // y = 1 - y: all gains together are 1.
  Run run("flyball = 1\n[blocks]\none = { type = \"Constant\" }\nsum = { type = \"Sum\", signs = \"+-\" }\n" +
          blocks + "[diagram]\nwires = [\"one -> sum.u1\", \"sum" + wires +
          " -> sum.u2\"]\nlog = [\"sum\"]\n");
  run.finish();
  CHECK(run.logged("sum", 10.0) == 0.5);
  REQUIRE(run.plan().loops.size() == 1);
  CHECK(run.plan().loops[0].tears.size() == 1);
}

TEST_CASE("A run that goes on from a checkpoint in a diagram with a loop gives the same bits") {
  Run first(cubic("{ method = \"dp5\" }"));
  for (int k = 0; k < 10; ++k) first.advance();
  Simulator second(read_model(cubic("{ method = \"dp5\" }")).plan, first.plan().diagram->simulation,
                   first.simulator().workspace());
  while (first.advance()) {
  }
  while (second.advance()) {
  }
  CHECK(first.simulator().workspace().values == second.workspace().values);
}

TEST_CASE("A value that is not finite in a loop is named with its block") {
  Run run(R"toml(
flyball = 1
[blocks]
x = { type = "Expression", formula = "u + 1" }
root = { type = "Expression", formula = "sqrt(u - 2)" }
[diagram]
wires = ["x -> root -> x"]
)toml");
  const SimulationError error = run.stop();
  CHECK(error.kind() == SimulationError::Kind::not_finite);
  CHECK(error.what() == std::string("root.y is nan at t = 0 s (u = 0)"));
}
