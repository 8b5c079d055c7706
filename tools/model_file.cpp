#include "tools/model_file.h"

#include "models/read_file.h"
#include "studies/file.h"

namespace flyball {

ModelFile load_model(const std::string& file, const std::vector<Override>& overrides) {
  ModelFile model;
  model.name = file;
  model.text = read_file(file, largest_model);
  Diagnostics diagnostics(file);
  if (auto diagram = read_diagram(model.text, diagnostics, overrides)) {
    model.plan = make_plan(std::make_shared<const Diagram>(*std::move(diagram)), diagnostics);
  }
  if (model.plan != nullptr) model.criteria = read_criteria(*model.plan, diagnostics);
  if (diagnostics.failed()) model.plan = nullptr;
  model.diagnostics = diagnostics.sorted();
  model.errors = count_errors(model.diagnostics);
  return model;
}

std::string listing(const std::vector<Diagnostic>& diagnostics) {
  std::string lines;
  for (const Diagnostic& diagnostic : diagnostics) lines += to_string(diagnostic) + '\n';
  return lines;
}

}  // namespace flyball
