#pragma once

#include <memory>
#include <string>
#include <vector>

#include "solvers/plan_system.h"

namespace flyball {

/// The rates of a plan with their derivatives by parameters, in a workspace of Jets.
class JetSystem final : public System<Jet> {
 public:
  /// `directions` names the parameter of each direction of the Jets, for messages.
  JetSystem(const Plan& plan, Workspace<Jet>& workspace, const std::vector<std::string>& directions)
      : plan_(plan), workspace_(workspace), directions_(directions) {}

  int size() const override { return plan_.layout.states(); }
  void rates(Jet t, const Jet* x, Jet* dx) override;
  std::string state_name(int i) const override { return plan_.slot_name(plan_.layout.first_state + i); }
  const Sparsity& pattern() const override { return plan_.pattern; }
  /// On numbers, of which this system keeps a workspace of its own from the first call on.
  void jacobian(double t, const double* x, double* values) override;

  /// Writes time and states into the workspace.
  void place(const Jet& t, const Jet* x);
  Jet* states() { return workspace_.values.data() + plan_.layout.first_state; }

  /// Throws SimulationError (not_finite) that names what is not finite: the value, or its derivative by which
  /// parameter.
  void require_finite(const Jet& x, double t, const std::string& name) const;

 private:
  const Plan& plan_;
  Workspace<Jet>& workspace_;
  const std::vector<std::string>& directions_;
  struct Numbers {
    explicit Numbers(const Plan& plan) : workspace(plan), system(plan, workspace) {}
    Workspace<double> workspace;
    PlanSystem system;
  };
  std::unique_ptr<Numbers> numbers_;
};

}  // namespace flyball
