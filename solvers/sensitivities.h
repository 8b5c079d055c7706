#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "models/plan.h"
#include "solvers/parameters.h"

namespace flyball {

/// Which derivatives are asked for.
struct SensitivityRequest {
  std::vector<std::string> parameters;  // "K" or "block.parameter"; initial values are parameters
  std::vector<std::string> signals;     // names of logged columns
  std::vector<double> times;            // [s], ascending, from 0 to the stop time
  ParameterSet set = {};                // parameters with other values than the model's
};

struct SensitivityOptions {
  double rtol = 1e-10;
  std::optional<double> atol;  // default: in the model's proportion to rtol
};

/// What makes a derivative less than it seems. Told once for each cause.
struct SensitivityWarning {
  enum class Kind {
    grazing,    // a signal only touches a threshold: derivatives are NaN from then on
    one_sided,  // several things happen at one time, and the parameter would part them
    opaque      // a block that runs on double alone has read it: its outputs carry no derivative
  };
  Kind kind = Kind::grazing;
  double time = 0.0;  // [s]
  int parameter = 0;  // number in the request
  std::string message;
};

/// Signals of a run and their derivatives by parameters, through hits and events, for as many parameter
/// values as wanted on one plan. One object a thread; any number of them share a plan.
///
/// A run on numbers finds what happens and when; beside it goes one run on Jets for each three parameters,
/// with steps of its own, whose errors of derivatives (by the logarithm of the parameter, or by itself where
/// it is 0) obey the same tolerances as values. docs/decisions/0015-sensitivities.md has the formulas.
///
/// At an instant, a signal and its derivative are those right after it.
class Sensitivities {
 public:
  /// Throws std::invalid_argument when a parameter or signal is not there, a parameter is structural or
  /// computed from others, or times are not ascending or out of the run.
  Sensitivities(std::shared_ptr<const Plan> plan, const SimulationSettings& settings,
                SensitivityRequest request, SensitivityOptions options = {});
  Sensitivities(Sensitivities&&) noexcept;
  ~Sensitivities();

  /// The request's parameters in the model [SI].
  const std::vector<double>& model_values() const;

  /// Runs with these values of the request's parameters [SI]. Throws std::invalid_argument when one is out of
  /// range, SimulationError as a run does, where a derivative is not finite, and where the model ends the run
  /// before the last time. Then nothing of it counts.
  void run(std::span<const double> parameters);

  /// Of the last run: numbers as in the request.
  double value(int time, int signal) const;
  double derivative(int time, int signal, int parameter) const;
  /// The same as rows: one row a time of one value a signal, and for each of these values one row of one
  /// derivative a parameter, as a Jacobian of residuals wants them.
  const std::vector<double>& values() const;
  const std::vector<double>& derivatives() const;
  const std::vector<SensitivityWarning>& warnings() const;

 private:
  class Run;
  std::unique_ptr<Run> run_;
};

}  // namespace flyball
