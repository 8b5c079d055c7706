#pragma once

#include <limits>

#include "solvers/reach.h"
#include "solvers/stepper.h"

namespace flyball {

/// Time alone, for systems without states: from instant to instant, at most max_step at once, so that changes
/// of side of what depends on time are seen. The constructor throws std::invalid_argument on states.
class DiscreteStep final : public Stepper<double> {
 public:
  DiscreteStep(System<double>& system, const StepperOptions& options) : max_step_(options.max_step) {
    if (system.size() > 0) throw std::invalid_argument("the method \"discrete\" integrates no states");
    if (!(max_step_ > 0.0)) throw std::invalid_argument("discrete steps need a max_step above 0");
  }

  void restart(double t, const double*, StepMemory&, bool) override {
    end_ = t;
    ++statistics_.restarts;
  }
  double step(double limit, StepMemory&) override {
    const Reach next = reach(max_step_, limit - end_, max_step_);
    end_ = next.lands ? limit : end_ + next.size;
    ++statistics_.steps;
    return end_;
  }
  const double* state() const override { return nullptr; }
  void interpolate(double, double*) override {}
  bool ends_with_rates() const override { return false; }
  void hold() { ++statistics_.restarts; }
  double largest() const { return std::numeric_limits<double>::max(); }

 private:
  double max_step_;
  double end_ = 0.0;
};

}  // namespace flyball
