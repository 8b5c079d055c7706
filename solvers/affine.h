#pragma once

#include <span>
#include <vector>

#include "models/plan.h"
#include "solvers/workspace.h"

namespace flyball {

/// Results of a program as y = offset + slope t + matrix x, valid while bits and held values stand still.
/// Most diagrams of few states are of this kind between two instants, and a product of a small matrix is many
/// times faster than the program. What is learned stays in the workspace, so that a checkpoint goes on with
/// it.
class AffineProgram {
 public:
  using Coefficients = Workspace<double>::Affine;
  /// Whether all results are finite.
  using Product = bool (*)(const Coefficients& map, double t, const double* x, double* y, int results, int n);

  /// `results` are slots of the value array; for the program of the rates they are empty.
  AffineProgram(const Plan& plan, const Program& program, std::vector<int> results);

  /// Whether the results are affine in states and time, and few enough for a matrix to be the faster way.
  bool applies() const { return applies_; }
  /// Whether they do not depend on time either, whatever bits and held values are.
  bool is_autonomous() const;

  /// Learns at the first call after `Coefficients::stale` was set: from the program on numbers, and where a
  /// bit or held value that scales something has changed, from the program on Jets. `x` are the states.
  /// False when a result is not finite.
  bool evaluate(double t, const double* x, double* y, Workspace<double>& workspace, Coefficients& map) {
    return map.stale ? learn(t, x, y, workspace, map) : product_(map, t, x, y, results(), states_);
  }
  /// Learns from results `y` that a sweep has just given at this time and state.
  void adopt(double t, const double* x, const double* y, Workspace<double>& workspace, Coefficients& map);
  /// The same where the results are slots of the value array.
  void adopt(Workspace<double>& workspace, Coefficients& map);

 private:
  bool is_affine() const;
  int results() const { return of_rates_ ? states_ : static_cast<int>(slots_.size()); }
  bool learn(double t, const double* x, double* y, Workspace<double>& workspace, Coefficients& map);
  void differentiate(Workspace<double>& workspace, Coefficients& map);
  bool switched(const Workspace<double>& workspace, Coefficients& map) const;

  const Plan& plan_;
  const Program& program_;
  std::vector<int> slots_;
  int states_;
  bool of_rates_;
  Product product_;
  bool applies_;
  std::vector<Workspace<Jet>> jets_;  // one, made when it is first needed
  std::vector<Jet> jet_rates_;
  std::vector<double> swept_;
};

}  // namespace flyball
