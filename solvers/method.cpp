#include "solvers/method.h"

#include <fmt/format.h>

#include <cmath>

namespace flyball {
namespace {

/// Whether each row that is asked for is at a hit: there `exact` has its state for nothing, while inside a
/// step it takes a matrix exponential.
bool rows_are_at_hits(const Plan& plan, const SimulationSettings& settings) {
  const double interval = settings.log_interval ? settings.log_interval->value() : settings.stop / 1000.0;
  for (const Rate& rate : plan.hit_rates) {
    const double periods = interval / rate.period.value();
    const bool whole = periods > 0.5 && std::fabs(periods - std::round(periods)) < 1e-9 * periods;
    if (rate.offset_ticks == 0 && whole) return true;
  }
  return false;
}

/// Measured on a motor with a sampled controller: 1.6 times as fast as dp5 where rows are at hits; three
/// times slower and more where rows or located events lie inside steps.
bool exact_pays(const Plan& plan, const PlanSystem& system, const SimulationSettings& settings) {
  const bool locates = !plan.located_relations.empty() || plan.layout.crossings() > 0;
  return system.is_linear() && !locates && rows_are_at_hits(plan, settings);
}

}  // namespace

std::string first_method(const Plan& plan, const PlanSystem& system, const SimulationSettings& settings) {
  if (settings.method != "auto") return settings.method;
  if (plan.layout.states() == 0) return "discrete";
  return exact_pays(plan, system, settings) ? "exact" : "auto";
}

MethodReport report_method(const std::string& method, const Plan& plan, const SimulationSettings& settings,
                           const StepMemory& memory) {
  if (settings.method != "auto") return {method, ""};
  if (method == "discrete") return {method, "there are no continuous states"};
  if (method == "exact") return {method, "between hits the rates are linear, and rows are asked for at hits"};
  if (!std::isfinite(memory.stiff_since)) return {"dp5", "the stiffness test found nothing"};
  return {"bdf",
          fmt::format("dp5 until t = {:.6g} s, where stiffness had limited 15 steps, most of all {}",
                      memory.stiff_since, plan.slot_name(plan.layout.first_state + memory.stiffest_state))};
}

}  // namespace flyball
