#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "models/dimensions.h"
#include "studies/file.h"
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

}  // namespace

int check_command(const CheckOptions& options) {
  std::vector<ModelFile> models;
  std::string lines;
  std::size_t errors = 0;
  bool unreadable = false;
  for (const std::string& name : options.models) {
    try {
      models.push_back(load_model(name, options.overrides));
    } catch (const FileError& error) {
      complain(fmt::format("error: {}\n", error.what()));
      unreadable = true;
      ++errors;
      continue;
    }
    ModelFile& model = models.back();
    if (model.plan) add_notes(model);
    complain(listing(model));
    errors += static_cast<std::size_t>(model.errors);
    if (!model.plan) continue;
    lines += fmt::format("{}: ok: {}\n", name, counts(*model.plan));
    if (options.units) lines += unit_lines(dimension_table(*model.plan->diagram));
  }
  print(options.json ? check_json(models, options.units) : lines);
  if (errors > 0) complain(counted(errors, "error") + '\n');
  if (unreadable) return exit_input_output;
  return errors > 0 ? exit_model_error : exit_done;
}

}  // namespace flyball
