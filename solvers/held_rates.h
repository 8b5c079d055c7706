#pragma once

#include <vector>

#include "solvers/stepper.h"
#include "solvers/workspace.h"

namespace flyball {

/// The rates of a plan as LinearRates. What is learned follows from parameters and from the bits and held
/// values that scale something, not from the point at which it is learned: wherever a run goes on from, it
/// finds the same.
class HeldRates {
 public:
  explicit HeldRates(const Plan& plan);

  /// For the bits and held values of this workspace; nullptr where the rates depend on time by itself. Only
  /// for rates that are affine.
  const LinearRates* of(const Workspace<double>& workspace) {
    if (switched(workspace)) learn(workspace);
    return constant_ ? &rates_ : nullptr;
  }
  /// What the rates read and do not write, in the order of LinearRates::inputs.
  void inputs(const Workspace<double>& workspace, double* w) const {
    for (const int slot : inputs_) *w++ = workspace.values[slot];
  }

 private:
  bool switched(const Workspace<double>& workspace);
  void learn(const Workspace<double>& workspace);
  void read_directions(const Workspace<Jet>& jets, int first, int last);
  void find_largest(const Workspace<Jet>& jets);

  const Plan& plan_;
  int states_;
  std::vector<int> inputs_;   // slots
  std::vector<int> outputs_;  // slots that the rates write on their way
  LinearRates rates_;
  bool constant_ = false;             // but for states and inputs
  std::vector<double> switches_;      // Plan::switches when it was learned
  std::vector<Workspace<Jet>> jets_;  // one, made when it is first needed
  std::vector<Jet> jet_rates_;
  std::vector<double> reach_;  // of `outputs_`, then of the rates: sums of the sizes of derivatives
};

}  // namespace flyball
