#include "studies/metrics/criteria.h"

#include <fmt/format.h>

#include <filesystem>
#include <limits>

namespace flyball {
namespace {

/// Reads each question into `read`; what is wrong goes to its place in the file.
template <class T>
void read_all(const std::vector<Question>& questions, const Plan& plan, Diagnostics& diagnostics,
              std::vector<std::pair<std::string, T>>& read) {
  const std::filesystem::path folder = std::filesystem::path(plan.diagram->file).parent_path();
  for (const Question& question : questions) {
    try {
      read.emplace_back(question.name, T(question.text, plan.columns, folder));
    } catch (const TextError& error) {
      diagnostics.error(question.at[std::min(error.offset(), question.text.size())], error.what());
    }
  }
}

Verdict without_run(const RunResult& result) {
  constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
  return {false, undefined, undefined, result.end,
          fmt::format("the run was {} at {:.6g} s", to_string(result.status), result.end)};
}

}  // namespace

Criteria read_criteria(const Plan& plan, Diagnostics& diagnostics) {
  Criteria criteria;
  read_all(plan.diagram->metrics, plan, diagnostics, criteria.metrics);
  read_all(plan.diagram->requirements, plan, diagnostics, criteria.requirements);
  return criteria;
}

Assessment assess(const Criteria& criteria, const RunResult& result) {
  const bool finished = result.status == RunStatus::finished;
  Assessment assessment;
  for (const auto& [name, metric] : criteria.metrics) {
    const double value =
        finished ? metric.evaluate(result.log, result.statistics) : std::numeric_limits<double>::quiet_NaN();
    assessment.metrics.push_back({name, metric.text(), metric.unit(), value});
  }
  for (const auto& [name, requirement] : criteria.requirements) {
    assessment.requirements.push_back(
        {name, requirement.text(), requirement.unit(),
         finished ? requirement.check(result.log, result.statistics) : without_run(result)});
  }
  return assessment;
}

}  // namespace flyball
