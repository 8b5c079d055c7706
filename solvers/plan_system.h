#pragma once

#include <initializer_list>
#include <string>

#include "solvers/affine.h"
#include "solvers/held_rates.h"
#include "solvers/workspace.h"

namespace flyball {

/// The rates of a plan in a workspace, as steppers ask for them.
class PlanSystem final : public System<double> {
 public:
  PlanSystem(const Plan& plan, Workspace<double>& workspace);

  int size() const override { return plan_.layout.states(); }
  void rates(double t, const double* x, double* dx) override;
  std::string state_name(int i) const override { return plan_.slot_name(plan_.layout.first_state + i); }
  const Sparsity& pattern() const override { return plan_.pattern; }
  void jacobian(double t, const double* x, double* values) override;

  const LinearRates* linear_rates() override {
    return affine_.applies() ? held_rates_.of(workspace_) : nullptr;
  }
  void held_inputs(double* w) const override { held_rates_.inputs(workspace_, w); }
  /// Whether linear_rates() will be there after each instant.
  bool is_linear() const { return affine_.applies() && affine_.is_autonomous(); }

  /// Whether the next call of `rates` will take more than a product.
  bool must_learn() const { return affine_.applies() && workspace_.rates_map.stale; }
  /// The rates at the end of an instant, whose last sweep stands in the workspace.
  void rates_after_sweep(double* dx);

  /// Whether `rates` leaves the outputs behind it in the workspace, at its point.
  bool rates_give_outputs() const { return !affine_.applies(); }

  /// Writes time and states into the workspace.
  void place(double t, const double* x);

  /// The time derivative of each relation and crossing (from Layout::first_relation on), along the flow with
  /// the rates `dx`, at what the workspace holds.
  const std::vector<double>& zero_rates(const double* dx);

 private:
  RunFrame<Jet> jet_frame();

  const Plan& plan_;
  Workspace<double>& workspace_;
  AffineProgram affine_;
  HeldRates held_rates_;
  Workspace<Jet> jets_;
  std::vector<Jet> jet_rates_;
  std::vector<double> zero_rates_;
};

/// Whether all of `n` numbers are finite.
bool all_finite(const double* x, int n);

/// Throws SimulationError (not_finite) that names block, port, time and inputs of the first bad number when
/// `programs` run again, instance by instance, on what the workspace holds. `hits` runs sampled blocks, too.
[[noreturn]] void throw_first_bad(std::initializer_list<const Program*> programs, const Plan& plan,
                                  Workspace<double>& workspace, bool hits = false);

/// The same for what a handler staged for a state or held value.
[[noreturn]] void throw_bad_next(int slot, double value, const Plan& plan,
                                 const Workspace<double>& workspace);

/// Checks what a sweep of unsampled blocks wrote: outputs must be finite, relations and crossings not NaN.
bool outputs_are_finite(const Plan& plan, const Workspace<double>& workspace);

}  // namespace flyball
