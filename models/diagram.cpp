#include "models/diagram.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "models/diagram_blocks.h"
#include "models/diagram_files.h"
#include "models/diagram_guesses.h"
#include "models/diagram_log.h"
#include "models/diagram_questions.h"
#include "models/diagram_simulation.h"
#include "models/diagram_unfold.h"
#include "models/diagram_wires.h"
#include "models/dimensions.h"
#include "models/language/messages.h"
#include "models/read_file.h"

namespace flyball {
namespace {

template <class T>
int index_of(const std::vector<T>& all, std::string_view name) {
  const auto found = std::ranges::find(all, name, &T::name);
  return found == all.end() ? -1 : static_cast<int>(found - all.begin());
}

void read_title(const Subsystem& root, Diagram& diagram) {
  const TomlValue* model = root.section("model");
  if (model == nullptr) return;
  root.report.check_keys(*model, "[model]", {"title", "source"});
  diagram.title = root.report.text(*model, "title");
  diagram.source = root.report.text(*model, "source");
}

/// Continuous states: "plant.x".
std::vector<std::string> state_names(const Diagram& diagram) {
  std::vector<std::string> names;
  for (const Instance& instance : diagram.instances) {
    if (instance.object == nullptr) continue;
    for (const SlotSpec& slot : instance.object->specification->slots) {
      if (slot.kind == SlotKind::state) names.push_back(instance.name + "." + slot.name);
    }
  }
  return names;
}

/// Everything below the definitions, which are checked already.
Diagram read_hierarchy(const Hierarchy& hierarchy) {
  const Subsystem& root = hierarchy.root();
  Diagram diagram;
  read_title(root, diagram);
  ModelParameters parameters(hierarchy);
  parameters.read();
  ModelBlocks blocks(parameters, hierarchy);
  blocks.read();
  ModelWires(blocks).read();
  const TomlValue* section = root.section("diagram");
  diagram.logged = read_log(section == nullptr ? nullptr : section->find("log"), blocks);
  const TomlValue* guesses = section == nullptr ? nullptr : section->find("guesses");
  if (guesses != nullptr) diagram.guesses = read_guesses(*guesses, blocks, Expressions(parameters, root));
  unfold(blocks, diagram);
  if (const TomlValue* simulation = root.section("simulation"))
    diagram.simulation = read_simulation(*simulation, state_names(diagram), Expressions(parameters, root));
  diagram.metrics = read_questions(root.section("metrics"), root.report);
  diagram.requirements = read_questions(root.section("requirements"), root.report);
  diagram.parameters = parameters.parameters();
  diagram.data_files = blocks.data_files();
  return diagram;
}

}  // namespace

int Diagram::find_instance(std::string_view name) const { return index_of(instances, name); }

int Diagram::find_parameter(std::string_view name) const { return index_of(parameters, name); }

std::optional<Diagram> read_diagram(std::string_view text, Diagnostics& diagnostics,
                                    const std::vector<Override>& overrides) {
  SubsystemTypes types(overrides, diagnostics);
  const SubsystemType* model = types.read(text);
  if (model == nullptr) return std::nullopt;
  Diagram diagram = read_hierarchy(Hierarchy(*model, overrides, diagnostics));
  diagram.file = diagnostics.file();
  diagram.used_files = types.used_files();
  if (!diagnostics.failed()) check_dimensions(diagram, diagnostics);
  return diagnostics.failed() ? std::nullopt : std::optional(std::move(diagram));
}

std::optional<Diagram> read_diagram(Diagnostics& diagnostics, const std::vector<Override>& overrides) {
  errno = 0;
  const auto text = read_file_content(diagnostics.file());
  if (text) return read_diagram(*text, diagnostics, overrides);
  diagnostics.error({}, message::unreadable(std::strerror(errno)));
  return std::nullopt;
}

}  // namespace flyball
