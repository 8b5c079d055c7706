#include "blocks/specification.h"

#include <algorithm>

namespace flyball {

int Specification::count(SlotKind kind) const {
  return static_cast<int>(std::ranges::count(slots, kind, &SlotSpec::kind));
}

bool Specification::may_have(SlotKind kind) const {
  return has(kind) || std::ranges::find(absent, kind, &SlotSpec::kind) != absent.end();
}

const PortSpec* Specification::port(std::string_view name) const {
  const auto found = std::ranges::find(ports, name, &PortSpec::name);
  return found == ports.end() ? nullptr : &*found;
}

}  // namespace flyball
