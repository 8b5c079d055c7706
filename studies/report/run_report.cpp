#include "studies/report/run_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "studies/figure.h"
#include "studies/report/model_of_result.h"
#include "studies/shell.h"

namespace flyball {
namespace {

using Mark = HtmlTable::Mark;

std::string unit_shown(const std::string& unit) { return unit == "1" || unit == "any" ? "" : unit; }

std::string number(double value) { return std::isnan(value) ? "none" : fmt::format("{:.6g}", value); }

int index_of(const std::vector<LogColumn>& columns, const std::string& name) {
  const auto found = std::ranges::find(columns, name, &LogColumn::name);
  return found == columns.end() ? -1 : static_cast<int>(found - columns.begin());
}

HtmlSection results(const Assessment& assessment) {
  HtmlSection section{"Results", {}};
  if (!assessment.requirements.empty()) {
    HtmlTable table{{"Requirement", "Verdict", "Margin", "Unit", "Found"}, {}, {}};
    for (const auto& [name, text, unit, verdict] : assessment.requirements) {
      table.rows.push_back({name, verdict.passed ? "passed" : "failed", number(verdict.margin),
                            unit_shown(unit), verdict.message});
      table.marks.push_back(verdict.passed ? Mark::passed : Mark::failed);
    }
    section.items.emplace_back(std::move(table));
  }
  if (!assessment.metrics.empty()) {
    HtmlTable table{{"Metric", "Value", "Unit", "Definition"}, {}, {}};
    for (const auto& [name, text, unit, value] : assessment.metrics)
      table.rows.push_back({name, number(value), unit_shown(unit), text});
    section.items.emplace_back(std::move(table));
  }
  return section;
}

HtmlFigure signals_over_time(const RunReportSources& sources) {
  HtmlFigure result{"", "time [s]", {}, false};
  for (const Panel& panel : figure_of(sources.facts.columns, "", "").panels) {
    HtmlFigure::Panel drawn{panel.label, sources.curves.time, {}};
    for (const Curve& curve : panel.curves) {
      // Of a CSV file, the first column is time, and gnuplot counts from 1.
      std::vector<double> values = sources.curves.values[static_cast<std::size_t>(curve.column) - 2];
      for (double& value : values) value *= curve.factor;
      drawn.curves.push_back({curve.label, std::move(values)});
    }
    result.panels.push_back(std::move(drawn));
  }
  return result;
}

HtmlSection figures(const RunReportSources& sources) {
  HtmlSection section{"Signals", {}};
  for (HtmlPath& path : robot_paths(sources.facts.columns, sources.curves))
    section.items.emplace_back(std::move(path));
  section.items.emplace_back(signals_over_time(sources));
  return section;
}

HtmlSection solver(const ResultFacts& facts) {
  HtmlTable table{{"", ""}, {}, {}};
  const std::string reason = facts.reason.empty() ? "" : ": " + facts.reason;
  table.rows.push_back({"run", fmt::format("{} at {:.10g} s{}", facts.status, facts.end, reason)});
  for (const auto& [name, value] : facts.solver) table.rows.push_back({name, value});
  return {"Solver", {std::move(table)}};
}

std::string value_of(const Parameter& parameter) {
  const Binding& binding = parameter.binding;
  if (binding.kind == Binding::Kind::formula) return binding.formula->text;
  return fmt::format("{:.6g}", binding.value);
}

HtmlTable parameters(const Diagram& diagram) {
  HtmlTable table{{"Parameter", "Value", "Unit", ""}, {}, {}};
  for (const Parameter& parameter : diagram.parameters) {
    if (parameter.binding.kind == Binding::Kind::parameter) continue;
    table.rows.push_back({parameter.name, value_of(parameter), unit_shown(parameter.unit), parameter.doc});
  }
  return table;
}

HtmlSection model(const RunReportSources& sources) {
  const ResultFacts& facts = sources.facts;
  HtmlTable facts_table{{"", ""}, {{"file", facts.model_file}}, {}};
  if (!facts.source.empty()) facts_table.rows.push_back({"source", facts.source});
  facts_table.rows.push_back({"hash", facts.model_hash});
  for (const Override& value : facts.overrides)
    facts_table.rows.push_back({"set", value.name + " = " + value.value});
  HtmlSection section{"Model", {std::move(facts_table)}};
  if (!sources.diagram_svg.empty()) section.items.emplace_back(HtmlDrawing{sources.diagram_svg});
  if (sources.plan != nullptr && !sources.plan->diagram->parameters.empty())
    section.items.emplace_back(parameters(*sources.plan->diagram));
  if (sources.model_text.empty()) {
    section.items.emplace_back(
        HtmlText{"The model's file is not there any more, or has changed since this run."});
  } else {
    section.items.emplace_back(HtmlListing{sources.model_text});
  }
  return section;
}

/// What the command line said in the place of the model; all of it where the model is not known any more.
std::string solver_options(const RunReportSources& sources) {
  const ResultFacts& facts = sources.facts;
  const SimulationSettings* model = sources.plan == nullptr ? nullptr : &sources.plan->diagram->simulation;
  std::string text;
  const auto add = [&](const char* option, const auto& value, auto own) {
    if (model == nullptr || model->*own != value) text += fmt::format(" --{} {}", option, value);
  };
  add("stop", facts.stop, &SimulationSettings::stop);
  add("solver", facts.asked_method, &SimulationSettings::method);
  add("rtol", facts.rtol, &SimulationSettings::rtol);
  add("atol", facts.atol, &SimulationSettings::atol);
  add("seed", facts.seed, &SimulationSettings::seed);
  return text;
}

HtmlSection again(const RunReportSources& sources) {
  const ResultFacts& facts = sources.facts;
  std::string command = "flyball run " + shell_quoted(facts.model_file);
  for (const Override& value : facts.overrides)
    command += " --set " + shell_quoted(value.name + "=" + value.value);
  command += solver_options(sources);
  command += " --output result.csv --report report.html";
  HtmlTable versions{{"Made with", "Version"}, {{"Flyball", facts.flyball}}, {}};
  for (const Version& library : facts.libraries) versions.rows.push_back({library.name, library.number});
  return {"Run it again", {HtmlListing{std::move(command)}, std::move(versions)}};
}

}  // namespace

ResultCurves curves_of(const Log& log) {
  ResultCurves curves;
  curves.values.resize(static_cast<std::size_t>(log.width()));
  for (std::int64_t row = 0; row < log.rows(); ++row) {
    curves.time.push_back(log.time(row));
    for (int c = 0; c < log.width(); ++c)
      curves.values[static_cast<std::size_t>(c)].push_back(log.value(row, c));
  }
  return curves;
}

std::vector<HtmlPath> robot_paths(const std::vector<LogColumn>& columns, const ResultCurves& curves) {
  std::vector<HtmlPath> paths;
  for (const LogColumn& column : columns) {
    if (column.name != "x" && !column.name.ends_with(".x")) continue;
    const std::string stem = column.name.substr(0, column.name.size() - 1);
    const int x = index_of(columns, column.name), y = index_of(columns, stem + "y");
    int heading = -1;
    for (const char* name : {"theta", "heading", "psi"})
      heading = std::max(heading, index_of(columns, stem + name));
    if (y < 0 || heading < 0) continue;
    const auto values = [&](int c) { return curves.values[static_cast<std::size_t>(c)]; };
    const std::string name = stem.empty() ? "robot" : stem.substr(0, stem.size() - 1);
    paths.push_back({"The way of " + name,
                     unit_shown(column.unit),
                     {{name, curves.time, values(x), values(y), values(heading)}},
                     {}});
  }
  return paths;
}

HtmlPage run_page(const RunReportSources& sources) {
  const ResultFacts& facts = sources.facts;
  const std::string file = std::filesystem::path(facts.model_file).filename().string();
  HtmlPage page{facts.title.empty() ? file : facts.title, "", {}, {}};
  page.subtitle = fmt::format("{}, {} s simulated with {}", file, facts.end, facts.method);
  if (facts.status != "finished") page.verdicts.emplace_back("the run was " + facts.status, false);
  const auto& requirements = facts.assessment.requirements;
  if (!requirements.empty()) {
    const auto failed = facts.assessment.failed();
    page.verdicts.emplace_back(
        failed == 0 ? fmt::format("{} of {} requirements passed", requirements.size(), requirements.size())
                    : fmt::format("{} of {} requirements failed", failed, requirements.size()),
        failed == 0);
  }
  if (!facts.assessment.empty()) page.sections.push_back(results(facts.assessment));
  if (!sources.curves.time.empty() && !facts.columns.empty()) page.sections.push_back(figures(sources));
  page.sections.push_back(solver(facts));
  page.sections.push_back(model(sources));
  page.sections.push_back(again(sources));
  return page;
}

}  // namespace flyball
