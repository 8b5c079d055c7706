#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "models/dimensions.h"
#include "models/read_file.h"
#include "studies/file.h"
#include "studies/language/run_table.h"
#include "studies/result_check.h"
#include "tools/commands.h"
#include "tools/console.h"
#include "tools/json.h"
#include "tools/model_file.h"

namespace flyball {
namespace {

std::string counted(std::size_t n, std::string_view thing) {
  return fmt::format("{} {}{}", n, thing, n == 1 ? "" : "s");
}

std::string counts(const Plan& plan) {
  return fmt::format("{}, {}, {}, {}", counted(plan.diagram->instances.size(), "block"),
                     counted(static_cast<std::size_t>(plan.layout.states()), "state"),
                     counted(plan.hit_rates.size(), "sample rate"),
                     counted(plan.crossing_records.size() + plan.located_relations.size(), "crossing"));
}

/// What a user may want to know of a diagram that is in order.
void add_notes(ModelFile& model) {
  for (const Chain& chain : model.plan->chains) {
    model.diagnostics.push_back({Diagnostic::Severity::note, model.name,
                                 model.plan->instance(chain.begins).at,
                                 "algebraic loop, solved wherever it is evaluated: " + chain.text});
  }
}

void append_units(std::string& lines, std::string_view heading, const std::vector<NamedUnit>& units) {
  if (units.empty()) return;
  std::size_t width = heading.size();
  for (const NamedUnit& named : units) width = std::max(width, named.name.size());
  fmt::format_to(std::back_inserter(lines), "\n  {:<{}}  unit\n", heading, width);
  for (const auto& [name, unit] : units) {
    fmt::format_to(std::back_inserter(lines), "  {:<{}}  {}\n", name, width, unit.empty() ? "-" : unit);
  }
}

/// A line a signal and a parameter; "-" where the model does not determine the unit, "1" for a plain number.
std::string unit_lines(const DimensionTable& table) {
  std::string lines;
  append_units(lines, "signal", table.signals);
  append_units(lines, "parameter", table.parameters);
  if (!table.notes.empty()) lines += '\n';
  for (const Diagnostic& note : table.notes) lines += to_string(note) + '\n';
  return lines;
}

std::string counts(const Study& study) {
  return fmt::format("{}, {}, {}, {}", counted(study.models.size(), "model"),
                     counted(study.cases.size(), "case"), counted(study.scenarios.size(), "scenario"),
                     counted(static_cast<std::size_t>(RunTable(study, study.cases).size()), "run"));
}

/// What was checked, and what was found.
struct Findings {
  std::vector<ModelFile> models;
  std::vector<CheckedStudy> studies;
  std::vector<ResultCheck> results;
  std::string lines;
  std::size_t errors = 0;
  bool unreadable = false;
};

void check_model(const std::string& name, const CheckOptions& options, Findings& findings) {
  ModelFile model = load_model(name, options.overrides);
  if (model.plan) add_notes(model);
  complain(listing(model.diagnostics));
  findings.errors += static_cast<std::size_t>(model.errors);
  if (model.plan) {
    findings.lines += fmt::format("{}: ok: {}\n", name, counts(*model.plan));
    if (options.units) findings.lines += unit_lines(dimension_table(*model.plan->diagram));
  }
  findings.models.push_back(std::move(model));
}

void check_study(const std::string& name, const std::string& text, Findings& findings) {
  Diagnostics diagnostics(name);
  const auto study = read_study(text, diagnostics);
  CheckedStudy checked{name, diagnostics.sorted(), study ? RunTable(*study, study->cases).size() : 0};
  complain(listing(checked.diagnostics));
  findings.errors += static_cast<std::size_t>(count_errors(checked.diagnostics));
  if (study) findings.lines += fmt::format("{}: ok: {}\n", name, counts(*study));
  findings.studies.push_back(std::move(checked));
}

void check_result_file(const std::string& name, Findings& findings) {
  ResultCheck result = check_result(std::filesystem::path(name));
  complain(listing(result.diagnostics));
  findings.errors += result.diagnostics.size();
  if (result.ok()) {
    findings.lines +=
        fmt::format("{}: ok: {}, {}\n", name, counted(result.rows, "row"), counted(result.columns, "column"));
  }
  findings.results.push_back(std::move(result));
}

void check_file(const std::string& name, const CheckOptions& options, Findings& findings) try {
  if (std::filesystem::path(name).extension() == ".csv") {
    check_result_file(name, findings);
  } else if (const std::string text = read_file(name, largest_model); is_study(text)) {
    check_study(name, text, findings);
  } else {
    check_model(name, options, findings);
  }
} catch (const FileError& error) {
  complain(fmt::format("error: {}\n", error.what()));
  findings.unreadable = true;
  ++findings.errors;
}

}  // namespace

int check_command(const CheckOptions& options) {
  Findings findings;
  for (const std::string& name : options.files) check_file(name, options, findings);
  print(options.json ? check_json(findings.models, options.units, findings.results, findings.studies)
                     : findings.lines);
  if (findings.errors > 0) complain(counted(findings.errors, "error") + '\n');
  if (findings.unreadable) return exit_input_output;
  return findings.errors > 0 ? exit_model_error : exit_done;
}

}  // namespace flyball
