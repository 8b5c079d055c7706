#pragma once

#include <functional>
#include <string>
#include <vector>

#include "studies/engine/evaluator.h"

namespace flyball {

/// What was found for one parameter [SI].
struct FittedParameter {
  std::string name;
  std::string unit;
  double start = 0.0, value = 0.0;
  double standard_error = 0.0;  // NaN where the data do not tell
  bool at_bound = false;
};

/// The answer of a fit.
struct FitResult {
  std::string name;
  bool converged = false;
  std::string reason;  // in words: why it ended
  std::vector<FittedParameter> parameters;
  std::vector<double> correlation;       // row by row, of the parameters
  double condition = 0.0;                // of the scaled Jacobian
  double cost_before = 0.0, cost = 0.0;  // half the sum of squares
  int simulations = 0, iterations = 0;
  std::string gradient;              // "exact" or "numeric"
  std::vector<std::string> remarks;  // plain sentences: what cannot be identified, why the gradient fell back
  std::vector<Setting> settings() const;  // what was found, to be set
};

/// Fits as [fit.NAME] says. Throws std::invalid_argument where it cannot begin: a file that does not fit, a
/// structural parameter. A simulation that fails is a step not taken. `progress` gets iteration and cost, and
/// ends the fit by giving false.
FitResult run_fit(const Study& study, const FitDefinition& fit, Evaluator& evaluator, int threads = 1,
                  const std::function<bool(int, double)>& progress = {});

}  // namespace flyball
