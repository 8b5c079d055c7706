#pragma once

#include <memory>
#include <string>
#include <vector>

#include "models/diagram_form.h"
#include "models/diagram_report.h"

namespace flyball {

/// [ports]: what wires reach of a subsystem. Seen from inside, inputs are sources and outputs are targets; a
/// slot has the same number on both sides.
struct Interface {
  /// An input that need not be connected.
  struct Default {
    const PortSpec* port = nullptr;  // of `outside`
    const TomlEntry* entry = nullptr;
    const TomlValue* value = nullptr;
  };

  std::unique_ptr<BlockForm> outside;
  std::unique_ptr<BlockForm> inside;
  std::vector<Default> defaults;
  std::vector<Position> positions;  // of the ports, in their order

  const PortSpec* port(std::string_view name) const { return outside->specification().port(name); }
  Position position(std::string_view port) const;
};

/// The ports of a subsystem that messages call `type`. `section` is nullptr where there are none.
Interface read_interface(const TomlValue* section, const std::string& type, const Report& report);

}  // namespace flyball
