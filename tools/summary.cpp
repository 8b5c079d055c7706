#include "tools/summary.h"

#include <fmt/format.h>

#include <cmath>

#include "studies/table.h"

namespace flyball {
namespace {

std::string reason_of(const RunResult& result, bool from_command_line) {
  if (result.settings.method == "auto") return "auto: " + result.method.reason;
  return from_command_line ? "asked for on the command line" : "named by the model";
}

std::string ending(const RunResult& result) {
  const std::string reason = result.status != RunStatus::finished || result.reason.empty()
                                 ? ""
                                 : fmt::format(" ({})", result.reason);
  return fmt::format("{} at t = {:.10g} s{}, after {:.3g} s", to_string(result.status), result.end, reason,
                     result.wall_time);
}

}  // namespace

std::string run_summary(const RunResult& result, const RunInputs& inputs, bool method_from_command_line) {
  const StepperStatistics& s = result.statistics.stepper;
  const std::string& title = result.plan->diagram->title;
  std::string text = title.empty() ? inputs.model_file : fmt::format("{} ({})", title, inputs.model_file);
  text += fmt::format("\n  run     {}\n", ending(result));
  text += fmt::format("  method  {} ({}), rtol {:g}, atol {:g}, steps of at most {:g} s\n",
                      result.method.method, reason_of(result, method_from_command_line), result.settings.rtol,
                      result.settings.atol, result.max_step);
  text += fmt::format("  steps   {}, {} rejected, {} rate evaluations, {} Jacobians\n", s.steps, s.rejected,
                      s.rate_evaluations, s.jacobians);
  text += fmt::format("  events  {}, {} sample hits, {} alarms\n", result.statistics.events,
                      result.statistics.hits, result.statistics.alarms);
  text += fmt::format("  rows    {}\n", result.log.rows());
  return text;
}

std::string final_values(const Log& log) {
  if (log.rows() == 0) return {};
  const std::int64_t last = log.rows() - 1;
  Table table({"signal", fmt::format("at {:.10g} s", log.time(last)), "unit"});
  for (int c = 0; c < log.width(); ++c) {
    const LogColumn& column = log.columns()[static_cast<std::size_t>(c)];
    const bool has_unit = column.unit != "any" && column.unit != "1";
    table.row({column.name, fmt::format("{:.6g}", log.value(last, c)), has_unit ? column.unit : ""});
  }
  return table.text();
}

std::string assessment_tables(const Assessment& assessment) {
  std::string text;
  if (!assessment.metrics.empty()) {
    Table table({"metric", "value", "unit"});
    for (const MetricResult& metric : assessment.metrics) {
      table.row({metric.name, std::isnan(metric.value) ? "none" : fmt::format("{:.6g}", metric.value),
                 metric.unit == "1" ? "" : metric.unit});
    }
    text += '\n' + table.text();
  }
  if (!assessment.requirements.empty()) {
    Table table({"requirement", "verdict", "found"});
    for (const RequirementResult& requirement : assessment.requirements) {
      table.row(
          {requirement.name, requirement.verdict.passed ? "passed" : "FAILED", requirement.verdict.message});
    }
    text += '\n' + table.text();
  }
  return text;
}

}  // namespace flyball
