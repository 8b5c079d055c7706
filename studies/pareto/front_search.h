#pragma once

#include <functional>
#include <span>
#include <vector>

#include "studies/pareto/front.h"

namespace flyball {

/// Thrown out of a search that was told to end.
struct SearchEnded {};

/// What an algorithm of optimisation sees of a study: decision vectors go in, objectives to be minimised come
/// out. All points that hold the requirements are shown to an archive.
class FrontSearch {
 public:
  FrontSearch(const Study& study, const ParetoDefinition& definition, Evaluator& evaluator, int threads,
              std::function<bool(double)> progress);

  std::size_t parameters() const { return definition_.parameters.size(); }
  std::size_t objectives() const { return definition_.minimise.size() + definition_.maximise.size(); }
  std::vector<double> lower() const;
  std::vector<double> upper() const;

  /// Of decision vectors one behind the other, their objectives in the same way. What a run that broke a
  /// requirement or gave no number gets is worse than all others, finite, and better the less is wrong: a
  /// swarm finds its way out of there. Throws SearchEnded.
  std::vector<double> fitness(std::span<const double> decisions);

  const ParetoArchive& archive() const { return archive_; }
  long evaluations() const { return evaluations_; }
  long failed() const { return failed_; }

 private:
  std::vector<RunRequest> requests(std::span<const double> decisions) const;
  void judge(std::span<const RunRecord> records, std::span<const double> decision,
             std::vector<double>& fitness);
  double unfinished(const RunRecord& record) const;
  double violation(const RunRecord& record) const;

  const Study& study_;
  const ParetoDefinition& definition_;
  Evaluator& evaluator_;
  int threads_;
  std::function<bool(double)> progress_;
  std::vector<int> scenarios_;
  ParetoArchive archive_;
  long evaluations_ = 0;
  long failed_ = 0;
};

}  // namespace flyball
