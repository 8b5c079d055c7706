#include "studies/language/number_place.h"

#include <algorithm>
#include <stdexcept>

#include "models/language/units.h"
#include "solvers/parameters.h"

namespace flyball {
namespace {

bool settable(const Plan& plan, const std::string& name) {
  try {
    settable_parameter(plan, name);
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

/// Of "block.parameter", which exists.
NumberPlace place_in_block(const Plan& plan, const std::string& name) {
  const std::size_t dot = name.rfind('.');
  const Instance& instance = plan.instance(plan.diagram->find_instance(name.substr(0, dot)));
  const std::vector<SlotSpec>& slots = instance.object->specification->slots;
  const auto bound = std::ranges::find(instance.parameters, name.substr(dot + 1),
                                       [&](const auto& parameter) { return slots[parameter.first].name; });
  const SlotSpec& slot = slots[bound->first];
  // A parameter of any unit keeps the dimension of the value that the model gives it.
  if (slot.unit == "any" && bound->second.unit) return {to_string(*bound->second.unit), slot.range};
  return {slot.unit, slot.range};
}

}  // namespace

std::optional<NumberPlace> number_place(const Plan& plan, const std::string& name) {
  if (plan.parameter_slot(name) < 0 || !settable(plan, name)) return std::nullopt;
  const int p = plan.diagram->find_parameter(name);
  if (p < 0) return place_in_block(plan, name);
  return NumberPlace{plan.diagram->parameters[p].unit, plan.diagram->parameters[p].range};
}

bool is_structure(const Plan& plan, const std::string& name) {
  const std::size_t dot = name.rfind('.');
  const int block = dot == std::string::npos ? -1 : plan.diagram->find_instance(name.substr(0, dot));
  if (block < 0) return false;
  const auto& structure = plan.instance(block).object->specification->structure;
  return std::ranges::find(structure, name.substr(dot + 1), &StructureSpec::key) != structure.end();
}

std::vector<std::string> number_places(const Plan& plan) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (number_place(plan, name)) names.push_back(name);
  };
  for (const Parameter& parameter : plan.diagram->parameters) add(parameter.name);
  for (const Instance& instance : plan.diagram->instances) {
    for (const auto& [slot, binding] : instance.parameters) {
      add(instance.name + "." + instance.object->specification->slots[slot].name);
    }
  }
  return names;
}

NameIndex visible_parameters(const Diagram& diagram, std::string_view name) {
  // The block of "motor.winding.gain" stands in the subsystem "motor", whose parameters are "motor.…".
  const std::string_view block = name.substr(0, std::min(name.rfind('.'), name.size()));
  const std::string path = std::string(block.substr(0, block.rfind('.') + 1));
  NameIndex visible;
  for (std::size_t p = 0; p < diagram.parameters.size(); ++p) {
    const std::string& full = diagram.parameters[p].name;
    const std::size_t local = full.rfind('.') + 1;
    if (path.starts_with(full.substr(0, local))) visible.emplace(full.substr(local), static_cast<int>(p));
  }
  return visible;
}

}  // namespace flyball
