#pragma once

#include <algorithm>
#include <string>

#include "blocks/specification.h"

namespace flyball {

/// "y" or "pose.x": the element of a port that a slot is, else the name of the slot.
inline std::string port_element(const Specification& spec, bool is_input, int slot) {
  for (const PortSpec& port : spec.ports) {
    const auto found = std::ranges::find(port.slots, slot);
    if (port.is_input != is_input || found == port.slots.end()) continue;
    return port.elements.empty() ? port.name : port.name + '.' + port.elements[found - port.slots.begin()];
  }
  return spec.slots[slot].name;
}

}  // namespace flyball
