#pragma once

#include <array>
#include <vector>

#include "solvers/lane_group.h"
#include "solvers/reach.h"
#include "solvers/stepper.h"

namespace flyball {

/// Dormand and Prince's method for a group in lockstep: the error of a step is that of the worst run. A run
/// with a rate that is not finite, or for which the step vanishes, is dropped from the group.
template <Isa isa>
class LaneStepper {
 public:
  /// With `drops_stiff`, a run in which stiffness limits the steps leaves the group, as AutoStep leaves dp5.
  LaneStepper(LaneGroup<isa>& group, const StepperOptions& options, bool drops_stiff);

  /// Begins at the time and states of the group. The step size stays; a `fresh` run has none.
  void restart(bool fresh);
  /// One accepted step, not beyond `limit`; without states, of the longest size that is allowed. Leaves the
  /// group at its end, its rates evaluated. Returns its time, or, when no run is left, anything.
  double step(double limit);
  /// Sets the group to a time inside the last step.
  void interpolate(double t);

  const StepperStatistics& statistics() const { return statistics_; }

 private:
  using T = Lanes<isa>;
  using Step = LaneStep<isa>;
  static constexpr int last_rate = Step::stages - 1;

  /// At the states that the group shows.
  void rates(double t, T* dx);
  double first_step(double remaining);
  double first_step_of(int lane, double h0) const;
  double guess_of(int lane) const;
  double norm_of(int lane, auto&& component) const;
  double leap(double remaining, double limit);
  void attempt(double end);
  double worst_error();
  void remember(double error, const Reach& taken, bool rejected);
  void drop_vanished();
  void drop_stiff();
  double step_times_stiffness(int lane) const;

  LaneGroup<isa>& group_;
  StepperOptions options_;
  std::vector<T> storage_;
  Step step_;
  bool drops_stiff_;
  StepMemory memory_;
  std::array<StiffnessCount, lane_count> stiffness_;
  std::array<double, lane_count> error_{};
  double begin_ = 0.0, end_ = 0.0;
  bool extended_ = false;
  StepperStatistics statistics_;
};

extern template class LaneStepper<Isa::baseline>;
extern template class LaneStepper<Isa::avx2>;

}  // namespace flyball
