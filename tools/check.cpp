#include <fmt/format.h>

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
    if (model.plan) lines += fmt::format("{}: ok: {}\n", name, counts(*model.plan));
  }
  print(options.json ? check_json(models) : lines);
  if (errors > 0) complain(counted(errors, "error") + '\n');
  if (unreadable) return exit_input_output;
  return errors > 0 ? exit_model_error : exit_done;
}

}  // namespace flyball
