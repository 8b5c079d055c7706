#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "solvers/affine.h"
#include "solvers/step_polynomial.h"
#include "solvers/workspace.h"

namespace flyball {

class PlanSystem;

/// Times this close are one instant: rounding of an alarm's own arithmetic, and of a located root.
inline double same_instant(double t) { return 16.0 * std::numeric_limits<double>::epsilon() * std::fabs(t); }

/// Watches the relations and crossings of a run for changes of sign, and finds when they happen.
class Zeros {
 public:
  Zeros(const Plan& plan, Workspace<double>& workspace);

  /// The slots of what is watched, in the order of positions.
  static std::vector<int> slots(const Plan& plan) { return slots_of(watch(plan)); }

  bool none() const { return watched_.empty(); }
  int size() const { return static_cast<int>(watched_.size()); }
  /// How often relations and crossings were evaluated between instants.
  long evaluations() const { return evaluations_; }

  /// What changed side at the point that the workspace holds: positions in the order relations, crossings.
  /// Evaluates first; after `rates` at the same point only the rest is evaluated.
  const std::vector<int>& changed(bool after_rates);

  /// The first time in (t0, t1] at which something has changed side, given that `changed` at t1 was not
  /// empty. Leaves relations, crossings and `changed` at that time.
  double locate(double t0, double t1, Stepper<double>& stepper);

  /// Takes the end of the step for the time of what was located just before it.
  void found_at(double t1, Stepper<double>& stepper) {
    evaluate_at(t1, stepper);
    collect();
  }

  /// At an instant that was located: forces the bits and sides of what `changed` to the side crossed to.
  /// Until the instant ends they keep it, unless their value moves: rounding must not take a located root
  /// back.
  void force();
  /// Sets the bit of a relation by its value; zero changes nothing. Returns whether it changed.
  bool settle(int slot);
  /// Evaluates crossings after a sweep; those that changed side in their direction, by number.
  const std::vector<int>& fired_crossings();
  /// Whether a crossing was forced in this instant.
  bool must_rearm() const;
  /// What was forced and is still at rounding level takes its side from the sign of its rate of change along
  /// the rates `dx`.
  void rearm(const double* dx, PlanSystem& system);
  /// Takes what is affine from the last sweep of an instant.
  void adopt_sweep() {
    if (affine_.applies() && workspace_.zeros_map.stale) affine_.adopt(workspace_, workspace_.zeros_map);
  }
  /// Ends an instant: nothing is forced any more.
  void release();

  /// "relation above of limit": for messages.
  std::string name(int watched) const;
  bool is_relation(int watched) const { return watched_[watched].relation; }
  /// Of the bit, or of the crossing.
  int number(int watched) const { return watched_[watched].number; }
  int slot(int watched) const { return watched_[watched].slot; }
  /// The position of a crossing.
  int position_of_crossing(int number) const { return first_crossing_ + number; }
  /// What the last `changed` or `locate` found.
  const std::vector<int>& found() const { return changed_; }

 private:
  struct Watched {
    int slot;
    bool relation;
    int number;  // of the bit or the side
    Direction direction;
  };

  static std::vector<Watched> watch(const Plan& plan);
  static std::vector<int> slots_of(const std::vector<Watched>& watched);
  double value(int slot) const { return workspace_.values[slot]; }
  int side(const Watched& w) const;
  bool wanted(const Watched& w, double z) const;
  bool is_held(int slot) const;
  void collect();
  void evaluate(bool after_rates);
  void evaluate_at(double t, Stepper<double>& stepper);
  double find(int watched, double t0, double t1, Stepper<double>& stepper);
  double slope(int watched, const double* dx) const;

  const Plan& plan_;
  Workspace<double>& workspace_;
  int first_crossing_;  // in watched_
  long evaluations_ = 0;
  std::vector<Watched> watched_;
  AffineProgram affine_;
  std::vector<double> affine_values_;
  StepPolynomial polynomial_;
  bool polynomial_fits_ = false;  // the step in which `locate` looks
  double evaluated_ =
      std::numeric_limits<double>::quiet_NaN();  // time inside the step that the workspace shows
  std::vector<int> changed_;
  std::vector<int> fired_;
  std::vector<unsigned char> forced_;  // of each slot from first_relation on
  std::vector<double> forced_value_, forced_level_;
  std::vector<double> scale_;    // of each watched: its size at the end of the step in which it changed
  std::vector<int> forced_now_;  // watched that this instant forced
};

}  // namespace flyball
