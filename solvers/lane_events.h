#pragma once

#include <vector>

#include "solvers/lane_stepper.h"

namespace flyball {

/// Watches the relations and crossings of a group: what Zeros does for one run. A root belongs to one lane.
template <Isa isa>
class LaneEvents {
 public:
  /// A change of side of a watched relation or crossing.
  struct Change {
    int watched;
    LaneMask lanes;
  };

  LaneEvents(LaneGroup<isa>& group, LaneStepper<isa>& stepper);

  bool none() const { return watched_.empty(); }
  /// Whether anything changed side at the end of a step, where the rates have just been evaluated.
  bool changed();
  /// The first time in (t0, t1] at which something has changed side. Leaves the group at that time.
  double locate(double t0, double t1);
  void found_at(double t1);
  const std::vector<Change>& found() const { return changed_; }

  bool is_relation(int watched) const { return watched < relations_; }
  /// Of the crossing.
  int number(int watched) const { return watched - relations_; }

  /// At a located instant: the lanes of `found` take the side crossed to.
  void force();
  /// Sets the bits of a relation by its values; zero changes nothing.
  void settle(int slot);
  /// Evaluates crossings after a sweep; those that changed side in their direction, by number.
  const std::vector<Change>& fired_crossings();
  /// The lanes in which a crossing was forced in this instant.
  LaneMask must_rearm() const;
  /// What was forced in a lane and is still at rounding level takes its side from the sign of its rate of
  /// change (PlanSystem::zero_rates).
  void rearm(int lane, const std::vector<double>& slopes);
  void release();

 private:
  using T = Lanes<isa>;
  using Arithmetic = LaneArithmetic<isa>;

  LaneMask changed_lanes(int watched) const;
  double value(int watched, int lane) const { return group_.values[watched_[watched]].lane(lane); }
  int side(int watched, int lane) const;
  void collect();
  void evaluate_at(double t);
  void take_side(int crossing, LaneMask above, LaneMask below);
  LaneMask keeps(int slot) const;

  LaneGroup<isa>& group_;
  LaneStepper<isa>& stepper_;
  int relations_;             // as many of `watched_` come first
  std::vector<int> watched_;  // slots
  std::vector<LaneSigns> signs_;
  std::vector<Change> changed_, fired_;
  std::vector<LaneMask> forced_;  // of each slot from first_relation on
  std::vector<T> forced_value_;
  std::vector<Change> forced_now_;
  std::vector<double> scale_;  // of each watched and lane: its size in the step in which it changed
  double evaluated_ = 0.0;     // time inside the step that the group shows
};

extern template class LaneEvents<Isa::baseline>;
extern template class LaneEvents<Isa::avx2>;

}  // namespace flyball
