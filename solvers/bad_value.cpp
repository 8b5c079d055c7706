#include "solvers/bad_value.h"

#include <fmt/format.h>

#include <cmath>

#include "solvers/errors.h"
#include "solvers/workspace.h"

namespace flyball {
namespace {

/// "u = 3, gain = 2": what the instance read, for the message.
std::string readings(const BlockObject& object, const int* index, const double* values) {
  const auto& slots = object.specification->slots;
  std::string text;
  for (int s = 0; s < static_cast<int>(slots.size()); ++s) {
    const SlotSpec& spec = slots[s];
    const bool read = spec.kind == SlotKind::input || spec.kind == SlotKind::param ||
                      spec.kind == SlotKind::state || spec.kind == SlotKind::held;
    if (!read) continue;
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", spec.name, values[index[s]]);
  }
  return text.empty() ? text : fmt::format(" ({})", text);
}

/// The number that this call made of a slot.
double made(const Op& op, int slot, const Frame<double>& frame) {
  return op.phase == Phase::rates ? frame.rates[slot - frame.first_state] : frame.values[slot];
}

/// The first slot that this call made bad; -1 when all is well.
int bad_result(const Op& op, const int* index, const Frame<double>& frame) {
  // A limit, and so a relation, may be infinite, and an alarm may never come.
  const bool finite = op.phase == Phase::outputs || op.phase == Phase::rates;
  for (int s = 0; s < op.stride; ++s) {
    if (op.object->specification->slots[s].kind != result_of(op.phase)) continue;
    const double value = made(op, index[s], frame);
    if (finite ? !std::isfinite(value) : std::isnan(value)) return s;
  }
  return -1;
}

}  // namespace

void throw_bad_value(const std::string& what, double value, int instance, const Plan& plan,
                     const double* values) {
  const std::string read =
      instance < 0 ? "" : readings(*plan.instance(instance).object, plan.index_of(instance), values);
  throw SimulationError(SimulationError::Kind::not_finite, values[0],
                        fmt::format("{} is {} at t = {} s{}", what, shown(value), values[0], read));
}

void check_call(const Op& op, int k, const Plan& plan, const Frame<double>& frame) {
  Op one = op;
  one.first += k * op.stride;
  one.count = 1;
  call(one, plan, frame);
  const int* index = plan.index.data() + one.first;
  const int s = bad_result(one, index, frame);
  if (s < 0) return;
  throw_bad_value((op.phase == Phase::rates ? "the rate of " : "") + plan.slot_name(index[s]),
                  made(one, index[s], frame), plan.placed[op.place + k], plan, frame.values);
}

}  // namespace flyball
