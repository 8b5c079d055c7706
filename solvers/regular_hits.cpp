#include "solvers/regular_hits.h"

#include <cmath>

namespace flyball {

void RegularHits::begin() {
  frame_ = frame(plan_, workspace_);
  // From then on what is staged is what was committed, until a handler stages it anew.
  for (int slot = program_.first_held; slot < program_.last_held; ++slot)
    next(slot) = workspace_.values[slot];
}

bool RegularHits::run(const Due& due, double largest) {
  switched_ = false;
  sweep(due);
  if (!is_plain(largest)) check_all();
  hold(due);
  return switched_;
}

void RegularHits::sweep(const Due& due) {
  for (const Op& op : program_.ops) {
    if (op.rate >= 0 && due.rates[op.rate] == 0) continue;
    call(op, plan_, frame_);
    for (int k = op.settle_first; k < op.settle_first + op.settle_count; ++k)
      switched_ = zeros_.settle(plan_.sweep.settle[k]) || switched_;
  }
}

/// Whether nothing is large, infinite or NaN.
bool RegularHits::is_plain(double largest) const {
  const double* v = frame_.values;
  bool plain = true;
  for (int s = plan_.layout.first_state; s < plan_.layout.first_held; ++s)
    plain &= std::fabs(v[s]) <= largest;
  for (const int s : program_.outputs) plain &= std::fabs(v[s]) <= largest;
  for (const int s : program_.relations) plain &= v[s] == v[s];
  return plain;
}

void RegularHits::check_all() {
  sweep_.run(nullptr);
  if (!outputs_are_finite(plan_, workspace_)) throw_first_bad({&plan_.sweep}, plan_, workspace_, true);
}

void RegularHits::hold(const Due& due) {
  for (const HitProgram::Handler& handler : program_.handlers) {
    if (due.rates[handler.rate] != 0) handler.on_sample(handler.self, frame_, handler.index);
  }
  const int count = program_.last_held - program_.first_held;
  if (count <= 0) return;
  const double* staged = &next(program_.first_held);
  if (!all_finite(staged, count)) throw_bad_held();
  double* held = workspace_.values.data() + program_.first_held;
  for (int k = 0; k < count; ++k) held[k] = staged[k];
}

void RegularHits::throw_bad_held() {
  for (const HitProgram::Handler& handler : program_.handlers) {
    for (const int slot : handler.held) {
      if (!std::isfinite(next(slot))) throw_bad_next(slot, next(slot), plan_, workspace_);
    }
  }
}

}  // namespace flyball
