#include "tests/systems/harness.h"

#include <filesystem>

#include "tests/source_dir.h"

namespace flyball::test {
namespace {

Model plan_of(std::optional<Diagram> diagram, Diagnostics& diagnostics) {
  if (!diagram) throw std::invalid_argument(text_of(diagnostics));
  Model model;
  model.settings = diagram->simulation;
  model.plan = make_plan(std::make_shared<const Diagram>(std::move(*diagram)), diagnostics);
  if (model.plan == nullptr) throw std::invalid_argument(text_of(diagnostics));
  return model;
}

std::pair<std::string_view, std::string_view> halves(std::string_view name) {
  const auto dot = name.find('.');
  return {name.substr(0, dot), name.substr(dot + 1)};
}

}  // namespace

std::string text_of(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics.sorted()) text += to_string(diagnostic) + "\n";
  return text;
}

Model read_model(std::string_view text) {
  Diagnostics diagnostics("model.toml");
  return plan_of(read_diagram(text, diagnostics), diagnostics);
}

Model load_model(const std::string& file, const std::vector<Override>& overrides) {
  Diagnostics diagnostics(file);
  return plan_of(read_diagram(diagnostics, overrides), diagnostics);
}

std::vector<std::string> model_files() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source_dir() + "/models")) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path().string());
  }
  std::ranges::sort(files);
  return files;
}

std::string refusal_of(std::string_view text) {
  try {
    read_model(text);
  } catch (const std::invalid_argument& refusal) {
    return refusal.what();
  }
  throw std::logic_error("the model was accepted");
}

void DiagramBuilder::add(const std::string& type, const std::string& name, Keys keys) {
  const BlockType* found = find_block_type(type);
  if (found == nullptr) throw std::invalid_argument("no block type " + type);
  add(*found, name, std::move(keys));
}

void DiagramBuilder::add(const BlockType& type, const std::string& name, Keys keys) {
  TableSettings settings(std::move(keys));
  Instance instance;
  instance.name = name;
  instance.object = std::make_shared<const BlockObject>(type.create(&settings));
  instance.at = {static_cast<int>(diagram_.instances.size()) + 1, 1};
  const auto& slots = instance.object->specification->slots;
  for (int s = 0; s < static_cast<int>(slots.size()); ++s) {
    if (slots[s].kind == SlotKind::param) {
      Binding binding;
      binding.value = settings.number(slots[s]).value_or(slots[s].fallback);
      instance.parameters.emplace_back(s, binding);
    } else if (slots[s].kind == SlotKind::input || slots[s].kind == SlotKind::object_input) {
      instance.inputs.emplace_back(s, Endpoint{});
    }
  }
  diagram_.instances.push_back(std::move(instance));
}

Endpoint DiagramBuilder::end(std::string_view port) const {
  const auto [block, name] = halves(port);
  const int instance = diagram_.find_instance(block);
  if (instance < 0) throw std::invalid_argument("no block " + std::string(block));
  const PortSpec* spec = diagram_.instances[instance].object->specification->port(name);
  if (spec == nullptr) throw std::invalid_argument("no port " + std::string(port));
  return {instance, spec->slots.at(0)};
}

void DiagramBuilder::wire(std::string_view from, std::string_view to) {
  const Endpoint input = end(to);
  auto& inputs = diagram_.instances[input.instance].inputs;
  std::ranges::find(inputs, input.slot, &std::pair<int, Endpoint>::first)->second = end(from);
}

void DiagramBuilder::log(const std::string& port) { diagram_.logged.push_back({port, "any", end(port)}); }

Model DiagramBuilder::build() {
  diagram_.simulation = simulation;
  Diagnostics diagnostics("diagram");
  return plan_of(std::move(diagram_), diagnostics);
}

SimulationError Run::stop() {
  try {
    simulator_.run();
  } catch (const SimulationError& error) {
    return error;
  }
  throw std::logic_error("the run reached its end");
}

std::vector<double> Run::advance_times() {
  std::vector<double> ends;
  bool more = true;
  while (more) {
    more = simulator_.advance();
    ends.push_back(simulator_.time());
  }
  return ends;
}

std::vector<double> Run::times() const {
  std::vector<double> all;
  for (std::int64_t row = 0; row < simulator_.log().rows(); ++row) all.push_back(simulator_.log().time(row));
  return all;
}

std::vector<double> Run::column(const std::string& name) const {
  const int number = column_number(name);
  std::vector<double> all;
  for (std::int64_t row = 0; row < simulator_.log().rows(); ++row)
    all.push_back(simulator_.log().value(row, number));
  return all;
}

double Run::logged(const std::string& name, double t) const {
  const int number = column_number(name);
  for (std::int64_t row = simulator_.log().rows(); row-- > 0;) {
    if (simulator_.log().time(row) == t) return simulator_.log().value(row, number);
  }
  throw std::invalid_argument("no row at this time");
}

int Run::column_number(const std::string& name) const {
  const auto& columns = simulator_.log().columns();
  const auto found = std::ranges::find(columns, name, &LogColumn::name);
  if (found == columns.end()) throw std::invalid_argument("no column " + name);
  return static_cast<int>(found - columns.begin());
}

int Run::slot(std::string_view name) const {
  const auto [block, local] = halves(name);
  const int instance = model_.plan->diagram->find_instance(block);
  if (instance < 0) throw std::invalid_argument("no block " + std::string(block));
  const auto& slots = model_.plan->instance(instance).object->specification->slots;
  const auto found = std::ranges::find(slots, local, &SlotSpec::name);
  if (found == slots.end()) throw std::invalid_argument("no slot " + std::string(name));
  return model_.plan->index_of(instance)[found - slots.begin()];
}

}  // namespace flyball::test
