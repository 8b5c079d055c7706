#include "models/diagram_interface.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "models/language/messages.h"
#include "models/language/names.h"

namespace flyball {
namespace {

using Kind = TomlValue::Kind;

/// Stands in for a block of the catalogue, so that wires treat both alike.
struct Face {
  BlockType type;
  Specification specification;
};

class InterfaceReader {
 public:
  InterfaceReader(std::string type, const Report& report) : report_(report) {
    outside_.type.name = inside_.type.name = std::move(type);
    outside_.specification.slots.resize(1);  // time, as in each block
  }

  void read(const TomlValue& section) {
    report_.check_keys(section, "[ports]", {"inputs", "outputs"});
    for (const char* key : {"inputs", "outputs"}) {
      const TomlValue* ports = section.find(key);
      if (ports == nullptr || !report_.expect(*ports, Kind::table, "a table such as { u = \"V\" }")) continue;
      for (const TomlEntry& entry : ports->entries) read_port(entry, key == std::string_view("inputs"));
    }
  }

  Interface take() {
    inside_.specification = outside_.specification;
    for (SlotSpec& slot : inside_.specification.slots) {
      slot.optional = false;
      if (slot.kind != SlotKind::time)
        slot.kind = slot.kind == SlotKind::input ? SlotKind::output : SlotKind::input;
    }
    for (PortSpec& port : inside_.specification.ports) port.is_input = !port.is_input;
    result_.outside = form_of(std::move(outside_));
    result_.inside = form_of(std::move(inside_));
    for (Interface::Default& given : result_.defaults) given.port = result_.port(given.entry->key);
    return std::move(result_);
  }

 private:
  static std::unique_ptr<BlockForm> form_of(Face face) {
    auto shared = std::make_shared<const Face>(std::move(face));
    BlockObject object;
    object.type = &shared->type;
    object.specification = &shared->specification;
    object.self = shared;
    return std::make_unique<BlockForm>(std::move(object));
  }

  void read_port(const TomlEntry& entry, bool is_input) {
    if (!is_name(entry.key)) return report_.error(entry.at, message::not_a_name(entry.key));
    if (outside_.specification.port(entry.key) != nullptr)
      return report_.error(entry.at, message::stands_twice(entry.key));
    PortSpec port;
    port.name = entry.key;
    port.is_input = is_input;
    std::vector<std::string> units{"any"};
    if (entry.value.is(Kind::table)) {
      report_.check_keys(entry.value, "port " + entry.key, keys(is_input));
      port.doc = report_.text(entry.value, "doc");
      if (const TomlValue* elements = entry.value.find("elements")) port.elements = read_elements(*elements);
      if (const TomlValue* unit = entry.value.find("unit")) units = read_units(*unit, port);
      if (const TomlValue* value = entry.value.find("default"); value != nullptr && is_input)
        result_.defaults.push_back({nullptr, &entry, value});
    } else if (entry.value.is(Kind::string)) {
      units = read_units(entry.value, port);
    } else {
      report_.error(entry.value, message::wrong_type("a unit in quotes or a table", entry.value));
    }
    add(std::move(port), units, entry);
  }

  static const std::vector<std::string>& keys(bool is_input) {
    static const std::vector<std::string> output{"unit", "doc", "elements"};
    static const std::vector<std::string> input{"unit", "doc", "elements", "default"};
    return is_input ? input : output;
  }

  std::vector<std::string> read_elements(const TomlValue& value) {
    constexpr int most = 1000;
    std::vector<std::string> names;
    if (value.is(Kind::integer)) {
      if (value.integer < 1 || value.integer > most) {
        report_.error(value, message::element_count(value.integer, most));
        return names;
      }
      for (int k = 1; k <= value.integer; ++k) names.push_back(std::to_string(k));
      return names;
    }
    if (!report_.expect(value, Kind::list, "names such as [\"x\", \"y\"], or how many")) return names;
    if (value.items.empty()) report_.error(value, message::no_elements());
    std::set<std::string> taken;
    for (const TomlValue& name : value.items) {
      if (!report_.expect(name, Kind::string, "a name in quotes")) continue;
      if (!is_name(name.text)) report_.error(name, message::not_a_name(name.text));
      if (!taken.insert(name.text).second) report_.error(name, message::stands_twice(name.text));
      names.push_back(name.text);
    }
    return names;
  }

  /// One unit for all elements, or one for each.
  std::vector<std::string> read_units(const TomlValue& value, const PortSpec& port) {
    if (!value.is(Kind::list)) return {read_unit(value)};
    std::vector<std::string> units;
    for (const TomlValue& item : value.items) units.push_back(read_unit(item));
    if (units.size() == port.elements.size()) return units;
    report_.error(value, message::unit_count(port.elements.size(), units.size()));
    return {"any"};
  }

  std::string read_unit(const TomlValue& value) {
    if (value.is(Kind::string) && value.text == "any") return "any";
    return report_.unit(value).value_or("any");
  }

  void add(PortSpec port, const std::vector<std::string>& units, const TomlEntry& entry) {
    Specification& spec = outside_.specification;
    const bool optional = !result_.defaults.empty() && result_.defaults.back().entry == &entry;
    for (std::size_t k = 0; k < std::max<std::size_t>(port.elements.size(), 1); ++k) {
      SlotSpec slot;
      slot.kind = port.is_input ? SlotKind::input : SlotKind::output;
      slot.name = port.elements.empty() ? port.name : fmt::format("{}.{}", port.name, port.elements[k]);
      slot.unit = units[units.size() == 1 ? 0 : k];
      slot.doc = port.doc;
      slot.optional = optional;
      port.slots.push_back(static_cast<int>(spec.slots.size()));
      spec.slots.push_back(std::move(slot));
    }
    spec.ports.push_back(std::move(port));
    result_.positions.push_back(entry.at);
  }

  const Report& report_;
  Face outside_, inside_;
  Interface result_;
};

}  // namespace

Position Interface::position(std::string_view port) const {
  const auto& ports = outside->specification().ports;
  return positions[std::ranges::find(ports, port, &PortSpec::name) - ports.begin()];
}

Interface read_interface(const TomlValue* section, const std::string& type, const Report& report) {
  InterfaceReader reader(type, report);
  if (section != nullptr) reader.read(*section);
  return reader.take();
}

}  // namespace flyball
