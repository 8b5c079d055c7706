#include "models/diagram.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "models/diagram_blocks.h"
#include "models/diagram_guesses.h"
#include "models/diagram_log.h"
#include "models/diagram_overrides.h"
#include "models/diagram_parameters.h"
#include "models/diagram_report.h"
#include "models/diagram_simulation.h"
#include "models/diagram_wires.h"
#include "models/dimensions.h"
#include "models/language/messages.h"
#include "models/read_file.h"

namespace flyball {
namespace {

constexpr int format_version = 1;

template <class T>
int index_of(const std::vector<T>& all, std::string_view name) {
  const auto found = std::ranges::find(all, name, &T::name);
  return found == all.end() ? -1 : static_cast<int>(found - all.begin());
}

class DiagramReader {
 public:
  DiagramReader(const TomlDocument& document, const std::vector<Override>& overrides,
                Diagnostics& diagnostics)
      : root_(document.root()),
        report_(document, overrides, diagnostics),
        parameters_(report_),
        blocks_(parameters_, report_) {
    diagram_.file = diagnostics.file();
  }

  Diagram read() {
    report_.check_keys(root_, "a model file",
                       {"flyball", "model", "parameters", "blocks", "diagram", "simulation"});
    check_version();
    if (const TomlValue* model = section("model")) read_model(*model);
    if (const TomlValue* parameters = section("parameters")) parameters_.read(*parameters);
    if (const TomlValue* blocks = section("blocks")) {
      blocks_.read(*blocks);
    } else if (root_.find("blocks") == nullptr) {
      report_.error({1, 1}, message::missing_section("blocks"));
    }
    read_diagram_section();
    if (const TomlValue* simulation = section("simulation")) {
      diagram_.simulation = read_simulation(*simulation, state_names(), parameters_, report_);
    }
    diagram_.parameters = parameters_.parameters();
    diagram_.instances = std::move(blocks_.instances());
    diagram_.data_files = blocks_.data_files();
    return std::move(diagram_);
  }

 private:
  const TomlValue* section(std::string_view name) {
    const TomlValue* found = root_.find(name);
    if (found == nullptr) return nullptr;
    return report_.expect(*found, TomlValue::Kind::table, "a section") ? found : nullptr;
  }

  void check_version() {
    const TomlValue* version = root_.find("flyball");
    if (version == nullptr) return report_.error({1, 1}, message::missing_version(format_version));
    if (!report_.expect(*version, TomlValue::Kind::integer, "the version of the file format")) return;
    if (version->integer != format_version) {
      report_.error(*version, message::unknown_version(version->integer, format_version));
    }
  }

  void read_model(const TomlValue& model) {
    report_.check_keys(model, "[model]", {"title", "source"});
    diagram_.title = report_.text(model, "title");
    diagram_.source = report_.text(model, "source");
  }

  void read_diagram_section() {
    const TomlValue* diagram = section("diagram");
    if (diagram != nullptr) report_.check_keys(*diagram, "[diagram]", {"wires", "log", "guesses"});
    const TomlValue* wires = diagram == nullptr ? nullptr : diagram->find("wires");
    ModelWires connections(blocks_, report_);
    if (wires != nullptr) connections.read(*wires);
    connections.check_missing();
    diagram_.logged = read_log(diagram == nullptr ? nullptr : diagram->find("log"), blocks_, report_);
    const TomlValue* guesses = diagram == nullptr ? nullptr : diagram->find("guesses");
    if (guesses != nullptr) diagram_.guesses = read_guesses(*guesses, blocks_, parameters_, report_);
  }

  std::vector<std::string> state_names() {
    std::vector<std::string> names;
    for (const Instance& instance : blocks_.instances()) {
      if (instance.object == nullptr) continue;
      for (const SlotSpec& slot : instance.object->specification->slots) {
        if (slot.kind == SlotKind::state) names.push_back(instance.name + "." + slot.name);
      }
    }
    return names;
  }

  const TomlValue& root_;
  Report report_;
  ModelParameters parameters_;
  ModelBlocks blocks_;
  Diagram diagram_;
};

}  // namespace

int Diagram::find_instance(std::string_view name) const { return index_of(instances, name); }

int Diagram::find_parameter(std::string_view name) const { return index_of(parameters, name); }

std::optional<Diagram> read_diagram(std::string_view text, Diagnostics& diagnostics,
                                    const std::vector<Override>& overrides) {
  auto document = parse_toml(text, diagnostics);
  if (!document) return std::nullopt;
  apply_overrides(overrides, document->root(), diagnostics);
  Diagram diagram = DiagramReader(*document, overrides, diagnostics).read();
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
