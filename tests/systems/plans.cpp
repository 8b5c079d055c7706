#include <cmath>

#include "solvers/plan_system.h"
#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

namespace {

/// x_i' = k (x_{i-1} - 2 x_i + x_{i+1}) with x_0 = 1 and x_{n+1} = 0.
Model chain(int n) {
  std::string blocks =
      "flyball = 1\n[blocks]\nfirst = { type = \"Constant\" }\nlast = { type = \"Constant\", value = 0.0 }\n";
  std::string wires = "[diagram]\nwires = [\n";
  for (int i = 1; i <= n; ++i) {
    const std::string k = std::to_string(i), before = std::to_string(i - 1), after = std::to_string(i + 1);
    blocks += "sum" + k + " = { type = \"Sum\", signs = \"+--+\" }\n";
    blocks += "gain" + k + " = { type = \"Gain\", gain = 25.0 }\n";
    blocks += "x" + k + " = { type = \"Integrator\" }\n";
    wires += "\"" + (i == 1 ? "first" : "x" + before) + " -> sum" + k + ".u1\", \"x" + k + " -> sum" + k +
             ".u2, sum" + k + ".u3\", \"" + (i == n ? "last" : "x" + after) + " -> sum" + k + ".u4\", \"sum" +
             k + " -> gain" + k + " -> x" + k + "\",\n";
  }
  return read_model(blocks + wires + "]\n");
}

/// Row-major df/dx of a plan at x, after an instant at t.
std::vector<double> dense_jacobian(const Model& model, double t, const std::vector<double>& x) {
  Workspace<double> workspace(*model.plan);
  initialise(*model.plan, workspace);
  PlanSystem system(*model.plan, workspace);
  const Sparsity& pattern = model.plan->pattern;
  std::vector<double> values(pattern.row.size());
  // What does not move during a step is computed by instants.
  run(model.plan->sweep, *model.plan, frame(*model.plan, workspace));
  system.jacobian(t, x.data(), values.data());
  std::vector<double> dense(x.size() * x.size());
  for (int c = 0; c < pattern.size; ++c) {
    for (int k = pattern.start[c]; k < pattern.start[c + 1]; ++k)
      dense[pattern.row[k] * x.size() + c] = values[k];
  }
  return dense;
}

/// The place of a block's only state among the states.
int state(const Model& model, const std::string& block) {
  const int instance = model.plan->diagram->find_instance(block);
  const Plan& plan = *model.plan;
  const auto& slots = plan.instance(instance).object->specification->slots;
  const auto found = std::ranges::find(slots, SlotKind::state, &SlotSpec::kind);
  return plan.index_of(instance)[found - slots.begin()] - plan.layout.first_state;
}

}  // namespace

TEST_CASE("A chain of any length takes three colours") {
  for (const int n : {3, 10, 100, 1000}) {
    const Model model = chain(n);
    CHECK(model.plan->colouring.colours == 3);
    CHECK(model.plan->pattern.row.size() == static_cast<std::size_t>(3 * n - 2));
  }
}

TEST_CASE("No two columns of one colour share a row") {
  const Model model = chain(50);
  const Sparsity& pattern = model.plan->pattern;
  std::vector<std::vector<int>> taken(model.plan->colouring.colours, std::vector<int>(pattern.size, 0));
  for (int c = 0; c < pattern.size; ++c) {
    for (int k = pattern.start[c]; k < pattern.start[c + 1]; ++k)
      CHECK(++taken[model.plan->colouring.colour[c]][pattern.row[k]] == 1);
  }
}

TEST_CASE("The pattern of the Jacobian contains the diagonal, and rows ascend") {
  const Model model = read_model(R"toml(
flyball = 1
[blocks]
one = { type = "Constant" }
x = { type = "Integrator" }
y = { type = "Integrator" }
z = { type = "Integrator" }
[diagram]
wires = ["one -> x -> y -> z"]
)toml");
  const Sparsity& pattern = model.plan->pattern;
  CHECK(pattern.row.size() == 3 + 2);
  for (int c = 0; c < pattern.size; ++c) {
    const auto begin = pattern.row.begin() + pattern.start[c],
               end = pattern.row.begin() + pattern.start[c + 1];
    CHECK(std::find(begin, end, c) != end);
    CHECK(std::is_sorted(begin, end));
  }
}

TEST_CASE("The Jacobian of a nonlinear diagram is exact") {
  // v' = mu (1 - x^2) v - x + 2 sin(3 x) / (1 + exp(v)), x' = v
  const Model model = read_model(R"toml(
flyball = 1
[parameters]
mu = 2.5
[blocks]
x = { type = "Integrator" }
v = { type = "Integrator" }
damping = { type = "Expression", inputs = ["x", "v"], formula = "mu*(1 - x^2)*v" }
drive = { type = "Expression", inputs = ["x", "v"], formula = "2*sin(3*x)/(1 + exp(v))" }
sum = { type = "Sum", signs = "+-+" }
[diagram]
wires = ["v -> x", "x -> damping.x, drive.x, sum.u2", "v -> damping.v, drive.v", "damping -> sum.u1",
         "drive -> sum.u3", "sum -> v"]
)toml");
  const double x = 0.7, v = -0.4, mu = 2.5, e = 1.0 + std::exp(v);
  std::vector<double> at(2);
  const int i = state(model, "x"), j = state(model, "v");
  at[i] = x;
  at[j] = v;
  const std::vector<double> jacobian = dense_jacobian(model, 0.0, at);
  // Of the same operations as the closed form, in another order: a few roundings of numbers below 10.
  CHECK(std::fabs(jacobian[i * 2 + i]) < 1e-14);
  CHECK(std::fabs(jacobian[i * 2 + j] - 1.0) < 1e-14);
  CHECK(std::fabs(jacobian[j * 2 + i] - (-2.0 * mu * x * v - 1.0 + 6.0 * std::cos(3.0 * x) / e)) < 1e-14);
  CHECK(std::fabs(jacobian[j * 2 + j] -
                  (mu * (1.0 - x * x) - 2.0 * std::sin(3.0 * x) * (e - 1.0) / (e * e))) < 1e-14);
}

TEST_CASE("The Jacobian is that of the branches which are taken") {
  const Model model = read_model(R"toml(
flyball = 1
[blocks]
x = { type = "Integrator", initial = -2.0 }
size = { type = "Abs" }
y = { type = "Integrator", initial = 5.0 }
limit = { type = "Saturation", upper = 1.0 }
[diagram]
wires = ["x -> size -> y -> limit -> x"]
)toml");
  Simulator simulator(model.plan, model.settings);
  simulator.advance();
  Workspace<double> workspace = simulator.workspace();
  PlanSystem system(*model.plan, workspace);
  std::vector<double> values(model.plan->pattern.row.size());
  const std::vector<double> states(workspace.values.begin() + model.plan->layout.first_state,
                                   workspace.values.begin() + model.plan->layout.first_held);
  system.jacobian(simulator.time(), states.data(), values.data());
  // y' = |x| = -x, and x' = 1 at the limit, whatever y is: one entry of -1, and zeros.
  CHECK(std::ranges::count(values, -1.0) == 1);
  CHECK(std::ranges::count(values, 0.0) == static_cast<long>(values.size()) - 1);
}

TEST_CASE("The Jacobian of a chain is tridiagonal, over all passes of colours") {
  const Model model = chain(9);
  std::vector<int> place;
  for (int i = 1; i <= 9; ++i) place.push_back(state(model, "x" + std::to_string(i)));
  const std::vector<double> jacobian = dense_jacobian(model, 0.0, std::vector<double>(9, 0.3));
  for (int r = 0; r < 9; ++r) {
    for (int c = 0; c < 9; ++c) {
      const double exact = r == c ? -50.0 : std::abs(r - c) == 1 ? 25.0 : 0.0;
      CHECK(jacobian[place[r] * 9 + place[c]] == exact);
    }
  }
}

TEST_CASE("A dense diagram takes more than one pass of Jets") {
  // Each state drives each: six colours, so two passes of four directions.
  const int n = 6;
  std::string text = "flyball = 1\n[blocks]\nfeedback = { type = \"StateSpace\", A = [";
  for (int r = 0; r < n; ++r) {
    text += "[";
    for (int c = 0; c < n; ++c) text += std::to_string(r * n + c + 1) + ".0,";
    text += "],";
  }
  text += "], B = [[0.0],[0.0],[0.0],[0.0],[0.0],[0.0]], C = [[1.0,0.0,0.0,0.0,0.0,0.0]] }\n";
  text += "zero = { type = \"Constant\" }\n[diagram]\nwires = [\"zero -> feedback\"]\n";
  const Model model = read_model(text);
  CHECK(model.plan->colouring.colours == n);
  const std::vector<double> jacobian = dense_jacobian(model, 0.0, std::vector<double>(n, 1.0));
  for (int k = 0; k < n * n; ++k) CHECK(jacobian[k] == k + 1.0);
}

TEST_CASE("Blocks of equal type and structure share one object, and stand in one batch") {
  const Model model = chain(100);
  std::vector<const BlockObject*> objects;
  for (const Instance& instance : model.plan->diagram->instances) objects.push_back(instance.object.get());
  std::ranges::sort(objects);
  objects.erase(std::unique(objects.begin(), objects.end()), objects.end());
  CHECK(objects.size() == 4);
  // Sums, gains, rates.
  CHECK(model.plan->rates.ops.size() == 3);
}
