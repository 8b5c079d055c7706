#include "solvers/stepper.h"
#include "tests/allocations.h"
#include "tests/catch.h"

using namespace flyball;
using namespace flyball::test;

namespace {

/// x'' = -x, whose matrix the method "exact" may ask for.
class Oscillator final : public System<double> {
 public:
  int size() const override { return 2; }
  void rates(double, const double* x, double* dx) override {
    dx[0] = x[1];
    dx[1] = -x[0];
  }
  std::string state_name(int i) const override { return i == 0 ? "position" : "velocity"; }
  const Sparsity& pattern() const override { return pattern_; }
  void jacobian(double, const double*, double* values) override {
    for (int k = 0; k < 4; ++k) values[k] = by_columns_[k];
  }
  const LinearRates* linear_rates() override { return &linear_; }

 private:
  Sparsity pattern_{2, {0, 2, 4}, {0, 1, 0, 1}};
  std::vector<double> by_columns_{0.0, -1.0, 1.0, 0.0};
  LinearRates linear_{.matrix = {0.0, 1.0, -1.0, 0.0}, .inputs = {}, .offset = {0.0, 0.0}, .version = 1};
};

}  // namespace

TEST_CASE("Steps and restarts do not allocate after the first") {
  for (const std::string& method : stepper_methods()) {
    INFO(method);
    if (method == "discrete") continue;  // integrates nothing, and owns no memory
    Oscillator system;
    const auto stepper = make_stepper(method, system, {.max_step = 1.0, .fixed_step = 0.01});
    StepMemory memory;
    double x[] = {1.0, 0.0};
    stepper->restart(0.0, x, memory, true);
    double t = stepper->step(100.0, memory);
    const long before = allocations();
    for (int i = 0; i < 100; ++i) {
      t = stepper->step(100.0, memory);
      stepper->interpolate(t, x);
      if (i % 10 == 0) stepper->restart(t, x, memory, true);
    }
    const long made = allocations() - before;
    CHECK(made == 0);
  }
}
