#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "studies/engine/evaluator.h"
#include "studies/fit/stencil.h"
#include "studies/fit/unknowns.h"

namespace flyball {

/// Requirements and metrics of whole runs as residuals. Their derivatives are central differences of runs at
/// a tolerance of 1e-10, all in one call of the evaluator.
///
/// A broken requirement is its margin, one that holds is 0. A metric is n + 1 residuals for n parameters,
/// which tell a least-squares solver what Newton's method knows: quadratic_residuals.h.
class Judgement {
 public:
  /// `runs` are the settings of each run that is judged.
  Judgement(const Study& study, const FitDefinition& fit, const std::vector<Unknown>& unknowns,
            std::vector<std::vector<Setting>> runs, Evaluator& evaluator, int threads);

  int size() const;
  /// Residuals, and, where `jacobian` is not null, their derivatives by the parameters over their scales, row
  /// by row. False where a run fails or has no number; `failure` then says why.
  bool evaluate(std::span<const double> parameters, double* residuals, double* jacobian);

  const std::string& failure() const { return failure_; }
  int simulations() const { return simulations_; }

 private:
  std::vector<RunRecord> run_all(const Stencil& stencil);
  RunRequest request(const std::vector<Setting>& settings, const std::vector<double>& point) const;
  bool judge_requirement(int requirement, std::span<const RunRecord> records, const Stencil& stencil,
                         double* residual, double* row);
  bool judge_metric(int metric, std::span<const RunRecord> records, const Stencil& stencil, double* residuals,
                    double* rows);

  const Study& study_;
  const FitDefinition& fit_;
  std::vector<Unknown> unknowns_;
  std::vector<std::vector<Setting>> runs_;
  Evaluator& evaluator_;
  int threads_;
  std::uint64_t seed_;  // of the model
  std::string failure_;
  int simulations_ = 0;
};

}  // namespace flyball
