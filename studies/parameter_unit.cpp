#include "studies/parameter_unit.h"

#include <algorithm>

#include "models/dimensions.h"

namespace flyball {

std::string parameter_unit(const Plan& plan, std::string_view name) {
  const DimensionTable table = dimension_table(*plan.diagram);
  const auto known = std::ranges::find(table.parameters, name, &NamedUnit::name);
  if (known != table.parameters.end()) return known->unit;
  const int slot = plan.parameter_slot(name);
  if (slot < 0 || plan.owner[slot] < 0) return {};
  const BlockObject& object = *plan.instance(plan.owner[slot]).object;
  const std::string& unit = object.specification->slots[plan.owner_local[slot]].unit;
  return unit == "any" ? std::string() : unit;
}

}  // namespace flyball
