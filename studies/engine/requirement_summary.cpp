#include "studies/engine/requirement_summary.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "studies/table.h"

namespace flyball {
namespace {

/// The first of several that are equally bad.
bool is_worse(const Verdict& verdict, const Verdict& worst) {
  if (verdict.passed != worst.passed) return worst.passed;
  if (std::isnan(verdict.margin) || std::isnan(worst.margin))
    return std::isnan(verdict.margin) && !std::isnan(worst.margin);
  return verdict.margin < worst.margin;
}

/// "case hand, scenario heavy, sample 3"
std::string where(const StudyData& data, const RequirementSummary::Worst& worst) {
  const PlaceColumns places(data.study, false);
  const std::vector<std::string> names = places.header(), cells = places.cells(worst.place);
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k) text += fmt::format("{} {}, ", names[k], cells[k]);
  if (data.study.monte_carlo.runs > 1) text += fmt::format("sample {}, ", worst.place.sample);
  return text + fmt::format("run {}", worst.run);
}

std::string with_unit(double x, const std::string& unit) {
  const bool has_unit = !unit.empty() && unit != "1" && unit != "any";
  return has_unit ? fmt::format("{} {}", shown_number(x), unit) : shown_number(x);
}

}  // namespace

std::vector<RequirementSummary> summarise_requirements(const StudyData& data) {
  std::vector<RequirementSummary> summaries;
  for (std::size_t k = 0; k < data.study.requirements.size(); ++k) {
    const auto& [name, text] = data.study.requirements[k];
    summaries.push_back({name, text, data.study.models[0].requirements[k].unit(), 0, 0, {}});
  }
  if (summaries.empty()) return summaries;
  data.store.read(0, std::numeric_limits<std::int64_t>::max(), [&](const StoredRun& run) {
    for (std::size_t k = 0; k < summaries.size(); ++k) {
      const Verdict& verdict = run.record.verdicts[k];
      RequirementSummary& summary = summaries[k];
      ++summary.runs;
      summary.passed += verdict.passed ? 1 : 0;
      if (!summary.worst || is_worse(verdict, summary.worst->verdict))
        summary.worst = {run.run, data.table.place(run.run), verdict};
    }
  });
  return summaries;
}

std::string requirements_csv(const std::vector<RequirementSummary>& summaries) {
  std::vector<std::string> header{"requirement", "text",         "unit",        "runs",       "passed",
                                  "worst run",   "worst margin", "worst value", "worst time", "message"};
  std::string text = csv_line(header);
  for (const RequirementSummary& s : summaries) {
    const auto& worst = s.worst.value();
    text +=
        csv_line({s.name, s.text, s.unit, std::to_string(s.runs), std::to_string(s.passed),
                  std::to_string(worst.run), csv_number(worst.verdict.margin),
                  csv_number(worst.verdict.value), csv_number(worst.verdict.time), worst.verdict.message});
  }
  return text;
}

std::string requirements_text(const StudyData& data, const std::vector<RequirementSummary>& summaries) {
  Table table({"requirement", "", "passed", "of", "worst margin", "at"});
  for (const RequirementSummary& s : summaries) {
    table.row({s.name, s.text, std::to_string(s.passed), std::to_string(s.runs),
               with_unit(s.worst->verdict.margin, s.unit), where(data, *s.worst)});
  }
  return table.text();
}

std::string violations(const StudyData& data, const std::vector<RequirementSummary>& summaries) {
  std::string text;
  for (const RequirementSummary& s : summaries) {
    if (s.holds()) continue;
    text += fmt::format("requirement {} ({}): broken in {} of {} runs, worst in {}: {}\n", s.name, s.text,
                        s.runs - s.passed, s.runs, where(data, *s.worst), s.worst->verdict.message);
  }
  return text;
}

}  // namespace flyball
