#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "studies/fit/judgement.h"
#include "studies/fit/loss.h"
#include "studies/fit/measurements.h"
#include "studies/fit/signal_model.h"

namespace flyball {

/// Measurements and the model that they are compared with.
struct ComparedRun {
  Measurements measured;
  std::vector<double> weights;  // of the matches
  SignalModel model;
};

/// All residuals of a fit as functions of the parameters over their scales: those of the data, run by run,
/// what the loss adds, then those of requirements and metrics.
class Objective {
 public:
  /// Runs go to `threads` threads.
  Objective(std::vector<Unknown> unknowns, std::vector<ComparedRun> runs, std::optional<Judgement> judgement,
            const Loss& loss, int threads);

  int size() const;
  int data_size() const { return data_size_; }  // residuals of the data, which come first
  /// False where the model cannot be run; `failure` then says why. The last point is remembered.
  bool evaluate(std::span<const double> scaled, double* residuals, double* jacobian);

  const std::vector<Unknown>& unknowns() const { return unknowns_; }
  std::vector<ComparedRun>& runs() { return runs_; }
  const std::string& failure() const { return failure_; }
  int simulations() const;
  /// "exact", "numeric", or "mixed".
  std::string gradient() const;
  std::vector<std::string> remarks() const;

 private:
  bool compare_all(bool derivatives);
  void fill_data();
  bool remembers(std::span<const double> scaled, bool derivatives) const;

  std::vector<Unknown> unknowns_;
  std::vector<ComparedRun> runs_;
  std::optional<Judgement> judgement_;
  Loss loss_;
  int threads_;
  int data_size_ = 0;
  std::vector<double> scaled_, parameters_;  // the last point
  std::vector<double> residuals_, jacobian_;
  bool has_residuals_ = false, has_jacobian_ = false;
  std::string failure_;
};

}  // namespace flyball
