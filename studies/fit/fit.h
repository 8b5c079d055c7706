#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "studies/engine/evaluator.h"

namespace flyball {

/// Why a fit cannot begin: one line for each thing that is wrong, as compilers write them.
class FitError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// What was found for one parameter [SI].
struct FittedParameter {
  std::string name;
  std::string unit;  // "1" for a number, empty where it is not known
  double start = 0.0, value = 0.0;
  double standard_error = 0.0;  // NaN where the data do not tell
  bool at_bound = false;
};

/// One signal at the times of the data [SI]: as measured, and as the model has it with the start values and
/// with what was found.
struct FittedSignal {
  std::string signal;
  std::string column;  // of the data file
  std::string unit;
  std::vector<double> data, before, after;
};

struct FittedExperiment {
  std::string name;
  std::string data;           // path of the file
  std::vector<double> times;  // [s]
  std::vector<FittedSignal> signals;
};

/// The answer of a fit.
struct FitResult {
  std::string name;
  bool converged = false;
  std::string reason;  // in words: why it ended
  std::vector<FittedParameter> parameters;
  std::vector<double> correlation;  // row by row, of the parameters
  double condition = 0.0;  // of the Jacobian of the data with columns scaled to length 1; NaN without data
  double cost_before = 0.0, cost = 0.0;  // half the sum of squares; NaN where the start cannot be simulated
  int residuals = 0;
  int simulations = 0, iterations = 0;  // a simulation brings its exact derivatives with it
  std::string gradient;                 // "exact", "numeric", or "mixed" where some residuals have either
  std::vector<std::string> remarks;  // plain sentences: what cannot be identified, why the gradient fell back
  std::vector<FittedExperiment> experiments;
  std::vector<Setting> settings() const;  // what was found, to be set
};

/// Fits as [fit.NAME] says, by the Levenberg-Marquardt method of Ceres. Residuals are
/// - for each row and match of an experiment: weight times (model - data), under the robust loss;
/// - for each requirement and experiment: its margin where that is negative, else 0;
/// - for each metric of `minimise` and experiment: numbers whose sum of squares is the metric, so that it
/// must
///   not be negative, and enters the cost with half its value.
/// Derivatives of signals are exact (solvers/sensitivities.h), those of requirements and metrics are central
/// differences. A simulation that fails is a step not taken.
///
/// Throws FitError where it cannot begin: a parameter that fixes structure, a start out of its bounds, data
/// that do not fit; FileError where a file of data cannot be read. `progress` gets iteration and cost, and
/// ends the fit by giving false.
FitResult run_fit(const Study& study, const FitDefinition& fit, Evaluator& evaluator, int threads = 1,
                  const std::function<bool(int, double)>& progress = {});

}  // namespace flyball
