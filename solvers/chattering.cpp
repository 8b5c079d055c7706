#include "solvers/chattering.h"

#include <fmt/format.h>

#include <algorithm>
#include <ranges>

namespace flyball {
namespace {

/// Whether a bit, or what the handler of a crossing may change, is among `slots`.
bool moves_any(const std::vector<bool>& slots, int watched, const Plan& plan, const Zeros& zeros) {
  if (zeros.is_relation(watched)) return slots[zeros.slot(watched)];
  const int instance = plan.crossing_records[zeros.number(watched)].instance;
  const int* index = plan.index_of(instance);
  const auto& specs = plan.instance(instance).object->specification->slots;
  return std::ranges::any_of(specs, [&](const SlotSpec& spec) {
    const bool state = spec.kind == SlotKind::state;
    return state || (spec.kind == SlotKind::held && slots[index[&spec - specs.data()]]);
  });
}

}  // namespace

std::vector<bool> behind_rates(const Plan& plan) {
  std::vector<bool> slots(plan.layout.size, false);
  const auto mark = [&](const Op& op, const int* index, const std::vector<int>& reads) {
    for (const int s : reads) {
      if (op.object->specification->slots[s].numeric()) slots[index[s]] = true;
    }
  };
  const auto each = [&](const Op& op, auto&& visit) {
    for (int k = 0; k < op.count; ++k) visit(plan.index.data() + op.first + k * op.stride);
  };
  for (const Op& op : plan.rates_only.ops) {
    each(op, [&](const int* index) {
      for (const auto& reads : op.object->rate_reads) mark(op, index, reads);
    });
  }
  // A block is called after those that it reads, so one way back reaches all; but for loops.
  for (std::vector<bool> before; before != slots && (before.empty() || !plan.loops.empty());) {
    before = slots;
    for (const Op& op : plan.sweep.ops | std::views::reverse) {
      if (op.phase != Phase::outputs || op.rate >= 0) continue;
      each(op, [&](const int* index) {
        for (int s = 0; s < op.stride; ++s) {
          const bool output = op.object->specification->slots[s].kind == SlotKind::output;
          if (output && slots[index[s]]) mark(op, index, op.object->reads[s]);
        }
      });
    }
  }
  return slots;
}

SimulationError chattering(double t, int events, std::vector<int> fired, const Plan& plan,
                           const Zeros& zeros) {
  const std::vector<bool> slots = behind_rates(plan);
  std::ranges::stable_partition(fired, [&](int k) { return moves_any(slots, k, plan, zeros); });
  std::string names;
  for (const int k : fired) names += (names.empty() ? "" : ", ") + zeros.name(k);
  return {SimulationError::Kind::chattering, t,
          fmt::format("chattering at t = {} s: {} events in a row without progress, by {}; the motion slides "
                      "along the switching condition or its events pile up: give the switch a hysteresis, or "
                      "end the run before",
                      t, events, names)};
}

}  // namespace flyball
