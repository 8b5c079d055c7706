#include "solvers/sweep.h"

#include <fmt/format.h>

#include <algorithm>

#include "solvers/errors.h"

namespace flyball {

void Sweep::run(const std::vector<unsigned char>* hits) {
  int done = 0;
  for (const ModeSpan& span : plan_.sweep.modes) {
    run(done, span.first, hits);
    settle(span, hits);
    done = span.last;
  }
  run(done, static_cast<int>(plan_.sweep.ops.size()), hits);
}

void Sweep::run(int first, int last, Hits hits) {
  const auto& loops = plan_.sweep.loops;
  for (auto span = std::ranges::lower_bound(loops, first, {}, &LoopSpan::first);
       span != loops.end() && span->first < last; ++span) {
    call_all(first, span->first, hits);
    solve_loop({plan_, plan_.sweep, *span, hits}, frame(plan_, workspace_), workspace_.loops);
    first = span->last;
  }
  call_all(first, last, hits);
}

void Sweep::call_all(int first, int last, Hits hits) {
  const auto f = frame(plan_, workspace_);
  for (int at = first; at < last; ++at) {
    const Op& op = plan_.sweep.ops[at];
    if (op.rate >= 0 && (hits == nullptr || (*hits)[op.rate] == 0)) continue;
    call(op, plan_, f);
    for (int k = op.settle_first; k < op.settle_first + op.settle_count; ++k)
      zeros_.settle(plan_.sweep.settle[k]);
  }
}

/// The outputs for the bits as they are, then the bits for these outputs, until they agree.
void Sweep::settle(const ModeSpan& span, Hits hits) {
  const auto relations = plan_.sweep.settle.begin() + span.settle_first;
  for (int round = 0; round <= span.settle_count; ++round) {
    run(span.first, span.last, hits);
    bool changed = false;
    for (int k = 0; k < span.settle_count; ++k) changed = zeros_.settle(relations[k]) || changed;
    if (!changed) return;
  }
  run(span.first, span.last, hits);
  std::vector<int> unsettled;
  for (int k = 0; k < span.settle_count; ++k) {
    if (zeros_.settle(relations[k])) unsettled.push_back(relations[k]);
  }
  if (!unsettled.empty()) throw_no_mode(span, unsettled);
}

void Sweep::throw_no_mode(const ModeSpan& span, const std::vector<int>& unsettled) const {
  std::string names;
  for (const int slot : unsettled) names += (names.empty() ? "" : ", ") + plan_.slot_name(slot);
  throw SimulationError(
      SimulationError::Kind::algebraic_loop, workspace_.values[0],
      fmt::format("algebraic loop at t = {} s: no consistent mode, {} switches itself over: {}; an "
                  "Integrator, a strictly proper TransferFcn or a UnitDelay anywhere in the chain breaks it",
                  workspace_.values[0], names, plan_.chains[span.chain].text));
}

}  // namespace flyball
