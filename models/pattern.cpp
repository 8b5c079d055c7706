#include <algorithm>
#include <memory>

#include "models/layout.h"

namespace flyball {
namespace {

/// The states that a value depends on, ascending. Shared: a block with one input depends on what that input
/// does.
using States = std::shared_ptr<const std::vector<int>>;

States joined(const States& a, const States& b) {
  if (a == nullptr || a == b) return b;
  if (b == nullptr) return a;
  if (std::ranges::includes(*a, *b)) return a;
  if (std::ranges::includes(*b, *a)) return b;
  auto both = std::make_shared<std::vector<int>>();
  std::ranges::set_union(*a, *b, std::back_inserter(*both));
  return both;
}

class PatternFinder {
 public:
  explicit PatternFinder(Plan& plan) : plan_(plan), of_slot_(plan.layout.size) {
    for (int k = 0; k < plan.layout.states(); ++k) {
      of_slot_[plan.layout.first_state + k] = std::make_shared<const std::vector<int>>(1, k);
    }
  }

  void run() {
    std::vector<States> row(plan_.layout.states());
    for (int k = 0; k < plan_.layout.states(); ++k)
      row[k] = of_slot_[plan_.layout.first_state + k];  // diagonal
    int done = 0;
    for (const LoopSpan& span : plan_.rates.loops) {
      propagate(done, span.first, row);
      close(span, row);
      done = span.last;
    }
    propagate(done, static_cast<int>(plan_.rates.ops.size()), row);
    compress(row);
  }

 private:
  void propagate(int first, int last, std::vector<States>& row) {
    for (int at = first; at < last; ++at) {
      const Op& op = plan_.rates.ops[at];
      for (int k = 0; k < op.count; ++k) {
        const int* index = plan_.index.data() + op.first + k * op.stride;
        for (int s = 0; s < op.stride; ++s) {
          const SlotKind kind = op.object->specification->slots[s].kind;
          if (op.phase == Phase::outputs && kind == SlotKind::output &&
              index[s] >= plan_.layout.first_output) {
            of_slot_[index[s]] = behind(*op.object, op.object->reads[s], index);
          } else if (op.phase == Phase::rates && kind == SlotKind::state) {
            States& states = row[index[s] - plan_.layout.first_state];
            states = joined(states, behind(*op.object, op.object->rate_reads[s], index));
          }
        }
      }
    }
  }

  /// All members of a loop depend on whatever any of them does.
  void close(const LoopSpan& span, std::vector<States>& row) {
    propagate(span.first, span.last, row);
    States all;
    for (const Loop::Tear& tear : plan_.loops[span.loop].tears) all = joined(all, of_slot_[tear.slot]);
    for (int at = span.first; at < span.last; ++at) {
      const Op& op = plan_.rates.ops[at];
      const auto& slots = op.object->specification->slots;
      for (int k = 0; k < op.count * op.stride; ++k) {
        const int slot = plan_.index[op.first + k];
        const bool output = slots[k % op.stride].kind == SlotKind::output;
        if (output && slot >= plan_.layout.first_output) of_slot_[slot] = joined(of_slot_[slot], all);
      }
    }
  }

  States behind(const BlockObject& object, const std::vector<int>& reads, const int* index) const {
    States result;
    for (const int s : reads) {
      if (!object.specification->slots[s].numeric()) continue;
      if (object.specification->slots[s].kind == SlotKind::relation) continue;  // bits are frozen
      result = joined(result, of_slot_[index[s]]);
    }
    return result;
  }

  void compress(const std::vector<States>& row) {
    Sparsity& pattern = plan_.pattern;
    pattern.size = static_cast<int>(row.size());
    pattern.start.assign(row.size() + 1, 0);
    for (const States& states : row) {
      for (const int c : *states) ++pattern.start[c + 1];
    }
    for (int c = 0; c < pattern.size; ++c) pattern.start[c + 1] += pattern.start[c];
    pattern.row.resize(pattern.start.back());
    std::vector<int> fill(pattern.start.begin(), pattern.start.end() - 1);
    for (int r = 0; r < pattern.size; ++r) {
      for (const int c : *row[r]) pattern.row[fill[c]++] = r;
    }
  }

  Plan& plan_;
  std::vector<States> of_slot_;
};

}  // namespace

void find_pattern(Plan& plan) {
  PatternFinder(plan).run();
  plan.colouring = colour_columns(plan.pattern);
}

Colouring colour_columns(const Sparsity& pattern) {
  const int n = pattern.size;
  std::vector<std::vector<int>> columns_of(n);  // of each row
  for (int c = 0; c < n; ++c) {
    for (int k = pattern.start[c]; k < pattern.start[c + 1]; ++k) columns_of[pattern.row[k]].push_back(c);
  }
  Colouring result{0, std::vector<int>(n, -1)};
  std::vector<int> taken_by;  // of each colour: the last column that it was refused to
  for (int c = 0; c < n; ++c) {
    for (int k = pattern.start[c]; k < pattern.start[c + 1]; ++k) {
      for (const int other : columns_of[pattern.row[k]]) {
        if (result.colour[other] >= 0) taken_by[result.colour[other]] = c;
      }
    }
    int colour = 0;
    while (colour < result.colours && taken_by[colour] == c) ++colour;
    if (colour == result.colours) {
      ++result.colours;
      taken_by.push_back(-1);
    }
    result.colour[c] = colour;
  }
  return result;
}

}  // namespace flyball
