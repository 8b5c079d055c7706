#include "studies/pareto/front_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace flyball {
namespace {

// Above all that objectives are in SI, and apart from each other: broken requirements, then runs without
// numbers.
constexpr double broken = 1e12;
constexpr double numberless = 3e12;

}  // namespace

FrontSearch::FrontSearch(const Study& study, const ParetoDefinition& definition, Evaluator& evaluator,
                         int threads, std::function<bool(double)> progress)
    : study_(study),
      definition_(definition),
      evaluator_(evaluator),
      threads_(threads),
      progress_(std::move(progress)),
      scenarios_(definition.scenarios) {
  if (scenarios_.empty()) scenarios_.push_back(0);
}

std::vector<double> FrontSearch::lower() const {
  std::vector<double> bounds;
  for (const Sought& sought : definition_.parameters) bounds.push_back(sought.lower);
  return bounds;
}

std::vector<double> FrontSearch::upper() const {
  std::vector<double> bounds;
  for (const Sought& sought : definition_.parameters) bounds.push_back(sought.upper);
  return bounds;
}

std::vector<RunRequest> FrontSearch::requests(std::span<const double> decisions) const {
  std::vector<RunRequest> result;
  for (std::size_t first = 0; first < decisions.size(); first += parameters()) {
    for (const int scenario : scenarios_) {
      RunRequest request{definition_.model, study_.scenarios[scenario].settings, study_.seed};
      for (std::size_t k = 0; k < parameters(); ++k) {
        request.settings.push_back({definition_.parameters[k].name, decisions[first + k]});
      }
      result.push_back(std::move(request));
    }
  }
  return result;
}

std::vector<double> FrontSearch::fitness(std::span<const double> decisions) {
  if (progress_) {
    const double part = static_cast<double>(evaluations_) / static_cast<double>(definition_.evaluations);
    if (!progress_(std::min(part, 1.0))) throw SearchEnded();
  }
  EvaluatorOptions options;
  options.threads = threads_;
  const std::vector<RunRecord> records = evaluator_.run(requests(decisions), options);
  std::vector<double> result;
  const std::size_t runs = scenarios_.size();
  for (std::size_t point = 0; point * parameters() < decisions.size(); ++point) {
    judge(std::span(records).subspan(point * runs, runs),
          decisions.subspan(point * parameters(), parameters()), result);
  }
  return result;
}

void FrontSearch::judge(std::span<const RunRecord> records, std::span<const double> decision,
                        std::vector<double>& fitness) {
  ++evaluations_;
  std::vector<double> objectives(this->objectives(), 0.0);
  double worst_end = 0.0, worst_violation = 0.0;
  for (const RunRecord& record : records) {
    worst_end = std::max(worst_end, unfinished(record));
    worst_violation = std::max(worst_violation, violation(record));
    if (record.status != RunStatus::finished) continue;
    const std::size_t minimised = definition_.minimise.size();
    for (std::size_t k = 0; k < objectives.size(); ++k) {
      const bool minimise = k < minimised;
      const int metric = minimise ? definition_.minimise[k] : definition_.maximise[k - minimised];
      objectives[k] += (minimise ? 1.0 : -1.0) * record.metrics[metric] / static_cast<double>(records.size());
    }
  }
  const bool has_numbers = std::ranges::all_of(objectives, [](double x) { return std::isfinite(x); });
  if (worst_end > 0.0 || !has_numbers) {
    ++failed_;
    std::ranges::fill(objectives, numberless * (1.0 + worst_end));
  } else if (worst_violation > 0.0) {
    std::ranges::fill(objectives, broken * (1.0 + worst_violation));
  } else {
    archive_.show({{decision.begin(), decision.end()}, objectives});
  }
  fitness.insert(fitness.end(), objectives.begin(), objectives.end());
}

/// 0 for a run that came to its end, else from 0 to 1 how much of it is missing.
double FrontSearch::unfinished(const RunRecord& record) const {
  if (record.status == RunStatus::interrupted) throw SearchEnded();
  if (record.status == RunStatus::finished) return 0.0;
  const double stop = study_.models[definition_.model].plan->diagram->simulation.stop;
  // Never 0: a run that fails at its very end has failed.
  return std::clamp(1.0 - record.end / stop, 1e-6, 1.0);
}

/// 0 where all requirements hold, else from 0 to 1.
double FrontSearch::violation(const RunRecord& record) const {
  if (record.status != RunStatus::finished) return 0.0;
  double sum = 0.0;
  for (const int requirement : definition_.requirements) {
    const Verdict& verdict = record.verdicts[requirement];
    if (verdict.passed) continue;
    const double excess = std::abs(verdict.margin);
    const double size = excess + std::abs(verdict.value);
    // A margin of 0 that is broken ("<") still counts.
    sum += std::isfinite(size) && size > 0.0 ? std::max(excess / size, 1e-6) : 1.0;
  }
  return sum / std::max<double>(1.0, static_cast<double>(definition_.requirements.size()));
}

}  // namespace flyball
