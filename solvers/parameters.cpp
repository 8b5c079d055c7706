#include "solvers/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace flyball {
namespace {

/// `name` is only called for the message.
void require(double value, const Range& range, auto&& name) {
  if (range.contains(value)) return;
  if (std::isnan(value)) throw std::invalid_argument(name() + " is not a number");
  throw std::invalid_argument(fmt::format("{} is {}, outside its range {}{}, {}{}", name(), value,
                                          range.lower_open ? '(' : '[', range.lower, range.upper,
                                          range.upper_open ? ')' : ']'));
}

}  // namespace

int settable_parameter(const Plan& plan, std::string_view name) {
  const int slot = plan.parameter_slot(name);
  if (slot < 0) throw std::invalid_argument(fmt::format("there is no parameter {}", name));
  const int p = plan.diagram->find_parameter(name);
  // A parameter that only repeats another one has its slot: writing it would change that one, too.
  if (p >= 0 && plan.diagram->parameters[p].binding.kind == Binding::Kind::parameter)
    throw std::invalid_argument(fmt::format("{} is computed from other parameters", name));
  require_settable(plan, slot);
  return slot;
}

void require_settable(const Plan& plan, int slot) {
  const bool literal = std::ranges::find(plan.literals, slot, &Start::slot) != plan.literals.end();
  if (!literal) {
    throw std::invalid_argument(fmt::format("{} is computed from other parameters", plan.slot_name(slot)));
  }
  const auto at = std::ranges::find(plan.model_slots, slot);
  if (at != plan.model_slots.end() && plan.diagram->parameters[at - plan.model_slots.begin()].structural) {
    throw std::invalid_argument(
        fmt::format("{} fixes the structure of a block: it takes a new plan", plan.slot_name(slot)));
  }
}

void set_parameters(const Plan& plan, const ParameterSet& set, Workspace<double>& workspace) {
  for (const auto& [slot, value] : set) workspace.values[slot] = value;
  derive(plan, workspace);
  require_in_range(plan, workspace);
}

void require_in_range(const Plan& plan, const Workspace<double>& workspace) {
  const std::vector<Parameter>& parameters = plan.diagram->parameters;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    require(workspace.values[plan.model_slots[p]], parameters[p].range, [&] { return parameters[p].name; });
  }
  for (int i = 0; i < static_cast<int>(plan.diagram->instances.size()); ++i) {
    const Instance& instance = plan.instance(i);
    for (const auto& [local, binding] : instance.parameters) {
      const SlotSpec& spec = instance.object->specification->slots[local];
      require(workspace.values[plan.index_of(i)[local]], spec.range,
              [&] { return fmt::format("{}.{}", instance.name, spec.name); });
    }
  }
}

}  // namespace flyball
