#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "solvers/sensitivities.h"
#include "studies/fit/unknowns.h"

namespace flyball {

/// Which signals of which runs a fit looks at.
struct SignalRequest {
  std::shared_ptr<const Plan> plan;
  SimulationSettings settings;
  ParameterSet set;                  // of this experiment
  std::vector<std::string> signals;  // names of logged columns
  std::vector<double> times;         // [s]; they do not fall
  bool exact = true;                 // whether derivatives are wanted from Sensitivities
};

/// Logged signals at given times as functions of the parameters, with their derivatives: exact ones, or
/// central differences where the model does not pass exact ones on. Runs are at a tolerance of 1e-10; they
/// last as long as the times.
class SignalModel {
 public:
  SignalModel(SignalRequest request, const std::vector<Unknown>& unknowns);

  /// Runs with these values of the parameters [SI]. False when the model cannot be run with them, or has no
  /// derivatives there; `failure` then says why. Exact derivatives come with every run, wanted or not.
  bool run(std::span<const double> parameters, bool derivatives);

  /// Of the last run: one row a time of one value a signal, and for each value one row of derivatives.
  const std::vector<double>& values() const { return values_; }
  const std::vector<double>& derivatives() const { return derivatives_; }
  bool has_derivatives() const { return has_derivatives_; }

  const std::string& failure() const { return failure_; }
  bool exact() const { return exact_ != nullptr; }
  /// Why derivatives are differences somewhere, or one-sided; plain sentences.
  const std::vector<std::string>& remarks() const { return remarks_; }
  int simulations() const { return simulations_; }

 private:
  void make_exact();
  bool run_exact(std::span<const double> parameters);
  bool run_plain(std::span<const double> parameters, std::vector<double>& values);
  bool differentiate();
  bool difference(std::size_t p, const std::vector<double>& at);
  void spread(const std::vector<double>& rows, int width, std::vector<double>& result) const;
  void remark(const std::string& text);
  void go_numeric(const std::string& why);

  SignalRequest request_;
  std::vector<Unknown> unknowns_;
  std::vector<double> times_;  // without repetitions
  std::vector<int> row_;       // of each time of the request, in times_
  std::vector<int> slots_;     // of the parameters
  std::vector<int> columns_;   // of the signals, in the plan's
  std::unique_ptr<Sensitivities> exact_;
  std::vector<double> parameters_;  // of the last run
  std::vector<double> values_, derivatives_;
  bool has_derivatives_ = false;
  std::string failure_;
  std::vector<std::string> remarks_;
  int simulations_ = 0;
};

}  // namespace flyball
