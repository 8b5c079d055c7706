#include "models/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "models/layout.h"

namespace flyball {

std::string Plan::slot_name(int slot) const {
  if (slot == 0) return "time";
  if (owner[slot] < 0) return diagram->parameters[owner_local[slot] - 1].name;
  const Instance& of = instance(owner[slot]);
  return fmt::format("{}.{}", of.name, of.object->specification->slots[owner_local[slot]].name);
}

int Plan::parameter_slot(std::string_view name) const {
  if (const int p = diagram->find_parameter(name); p >= 0) return model_slots[p];
  const auto dot = name.rfind('.');
  if (dot == std::string_view::npos) return -1;
  const int i = diagram->find_instance(name.substr(0, dot));
  if (i < 0) return -1;
  for (const auto& [local, binding] : instance(i).parameters) {
    const SlotSpec& spec = instance(i).object->specification->slots[local];
    if (spec.name == name.substr(dot + 1) && !spec.fixed) return index_of(i)[local];
  }
  return -1;
}

void plan_hits(Plan& plan, Diagnostics& diagnostics) {
  std::optional<Rational> base;
  const int n = static_cast<int>(plan.diagram->instances.size());
  plan.rate_of.assign(n, -1);
  for (int i = 0; i < n; ++i) {
    const BlockObject& object = *plan.instance(i).object;
    const Specification& spec = *object.specification;
    if (!spec.sampled()) continue;
    const auto same = [&](const Rate& r) { return r.period == *spec.period && r.offset == spec.offset; };
    auto rate = std::ranges::find_if(plan.hit_rates, same);
    if (rate == plan.hit_rates.end()) {
      base = base ? common_divisor(*base, *spec.period) : *spec.period;
      if (base && spec.offset.numerator() > 0) base = common_divisor(*base, spec.offset);
      if (!base) {
        diagnostics.error(plan.instance(i).at,
                          fmt::format("the sample time of {} has no common tick with those before it: their "
                                      "common divisor does not fit 64 bits",
                                      plan.instance(i).name));
        return;
      }
      Rate next;
      next.period = *spec.period;
      next.offset = spec.offset;
      rate = plan.hit_rates.insert(rate, std::move(next));
    }
    plan.rate_of[i] = static_cast<int>(rate - plan.hit_rates.begin());
    if (object.type->kernels.on_double.on_sample != nullptr) rate->handlers.push_back(i);
  }
  if (!base) return;
  plan.base_tick = *base;
  for (Rate& rate : plan.hit_rates) {
    rate.period_ticks = divide(rate.period, *base).value_or(Rational(1)).numerator();
    rate.offset_ticks = divide(rate.offset, *base).value_or(Rational(0)).numerator();
  }
}

std::shared_ptr<const Plan> make_plan(std::shared_ptr<const Diagram> diagram, Diagnostics& diagnostics) {
  auto plan = std::make_shared<Plan>();
  plan->diagram = std::move(diagram);
  const std::optional<Order> order = Order::of(*plan->diagram, diagnostics);
  const int before = diagnostics.errors();
  plan_hits(*plan, diagnostics);
  if (!order || diagnostics.errors() > before) return nullptr;
  lay_out(*plan, *order);
  write_programs(*plan, *order);
  find_pattern(*plan);
  return plan;
}

}  // namespace flyball
