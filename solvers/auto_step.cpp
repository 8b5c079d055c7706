#include "solvers/auto_step.h"

#include <algorithm>
#include <cmath>

#include "solvers/cvode.h"

namespace flyball {
namespace {

bool is_stiff(const StepMemory& memory) { return std::isfinite(memory.stiff_since); }

}  // namespace

AutoStep::AutoStep(System<double>& system, const StepperOptions& options)
    : system_(system), options_(options), explicit_(system, options) {}

void AutoStep::restart(double t, const double* x, StepMemory& memory, bool changed) {
  // The first restart begins a run, or goes on from a checkpoint with its counts.
  if (changed && begun_) memory.stiffness.restart();
  begun_ = true;
  if (!is_stiff(memory)) {
    end_ = t;
    return explicit_.restart(t, x, memory, changed);
  }
  if (bdf_ == nullptr) {
    bdf_ = make_bdf(system_, options_);
    memory.stiff_since = std::min(memory.stiff_since, t);  // an event may have come before the step's end
    changed = true;
  }
  bdf_->restart(t, x, memory, changed);
}

double AutoStep::step(double limit, StepMemory& memory) {
  if (is_stiff(memory)) {
    if (bdf_ == nullptr) restart(end_, explicit_.state(), memory, true);
    return bdf_->step(limit, memory);
  }
  end_ = explicit_.step(limit, memory);
  test(memory);
  return end_;
}

void AutoStep::test(StepMemory& memory) const {
  if (!memory.stiffness.due()) return;
  // At max_step neither stability nor accuracy is the limit, and another method would not do better.
  const bool limited =
      memory.size < options_.max_step && explicit_.step_times_stiffness() > StiffnessCount::limit;
  if (!memory.stiffness.add(limited)) return;
  memory.stiff_since = end_;
  memory.stiffest_state = explicit_.limiting_state();
}

StepperStatistics AutoStep::statistics() const {
  StepperStatistics all = explicit_.statistics();
  if (bdf_ == nullptr) return all;
  const StepperStatistics stiff = bdf_->statistics();
  all.steps += stiff.steps;
  all.rejected += stiff.rejected;
  all.rate_evaluations += stiff.rate_evaluations;
  all.jacobians += stiff.jacobians;
  all.restarts += stiff.restarts;
  return all;
}

}  // namespace flyball
