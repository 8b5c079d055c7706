#include "solvers/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace flyball {
namespace {

void require(const std::string& name, double value, const Range& range) {
  if (range.contains(value)) return;
  if (std::isnan(value)) throw std::invalid_argument(name + " is not a number");
  throw std::invalid_argument(fmt::format("{} is {}, outside its range {}{}, {}{}", name, value,
                                          range.lower_open ? '(' : '[', range.lower, range.upper,
                                          range.upper_open ? ')' : ']'));
}

}  // namespace

int settable_slot(const Plan& plan, std::string_view name) {
  const int slot = plan.parameter_slot(name);
  if (slot < 0) throw std::invalid_argument(fmt::format("there is no parameter {}", name));
  const bool literal = std::ranges::find(plan.literals, slot, &Start::slot) != plan.literals.end();
  if (!literal) throw std::invalid_argument(fmt::format("{} is computed from other parameters", name));
  const int p = plan.diagram->find_parameter(name);
  if (p >= 0 && plan.diagram->parameters[p].structural) {
    throw std::invalid_argument(fmt::format("{} fixes the structure of a block: it takes a new plan", name));
  }
  return slot;
}

void require_in_range(const Plan& plan, const Workspace<double>& workspace) {
  const Diagram& diagram = *plan.diagram;
  for (std::size_t p = 0; p < diagram.parameters.size(); ++p) {
    const Parameter& parameter = diagram.parameters[p];
    require(parameter.name, workspace.values[plan.model_slots[p]], parameter.range);
  }
  for (std::size_t i = 0; i < diagram.instances.size(); ++i) {
    const Instance& instance = diagram.instances[i];
    for (const auto& [local, binding] : instance.parameters) {
      const SlotSpec& spec = instance.object->specification->slots[local];
      const double x = workspace.values[plan.index_of(static_cast<int>(i))[local]];
      require(fmt::format("{}.{}", instance.name, spec.name), x, spec.range);
    }
  }
}

}  // namespace flyball
