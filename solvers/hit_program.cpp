#include "solvers/hit_program.h"

#include <algorithm>
#include <utility>

namespace flyball {
namespace {

class HitProgramWriter {
 public:
  explicit HitProgramWriter(const Plan& plan)
      : plan_(plan),
        varies_(plan.layout.size, false),
        moves_(plan.layout.size, false),
        jumps_(plan.layout.size, false),
        needed_(plan.layout.size, false),
        in_rates_(plan.placed.size(), false),
        computed_(plan.placed.size(), false) {}

  HitProgram write() {
    HitProgram program;
    if (!has_only_hits()) return program;
    find_varying();
    if (!relations_and_alarms_stand_still()) return program;
    find_computed();
    program.applies = true;
    for (const Op& op : plan_.sweep.ops) append(op, program);
    for (std::vector<int>* slots : {&program.outputs, &program.relations}) {
      std::ranges::sort(*slots);
      slots->erase(std::unique(slots->begin(), slots->end()), slots->end());
    }
    append_handlers(program);
    program.logs_jump =
        std::ranges::any_of(plan_.columns, [&](const LogColumn& column) { return jumps_[column.slot]; });
    return program;
  }

 private:
  const BlockObject& object(int instance) const { return *plan_.instance(instance).object; }
  const std::vector<SlotSpec>& slots(int instance) const { return object(instance).specification->slots; }
  bool sampled(int instance) const { return plan_.rate_of[instance] >= 0; }

  bool has_only_hits() const {
    const Layout& layout = plan_.layout;
    const bool plain = layout.crossings() == 0 && layout.objects == 0 && plan_.run_ends.empty() &&
                       plan_.steps.ops.empty() && plan_.loops.empty() && plan_.sweep.modes.empty();
    return plain && !plan_.hit_rates.empty() && std::ranges::none_of(plan_.placed, [&](int instance) {
             return sampled(instance) && object(instance).specification->has(SlotKind::state);
           });
  }

  /// Calls `visit(place, instance, index)` for all instances of an operation.
  void each(const Op& op, auto&& visit) const {
    for (int k = 0; k < op.count; ++k) {
      visit(op.place + k, plan_.placed[op.place + k], plan_.index.data() + op.first + k * op.stride);
    }
  }

  /// Calls `visit(slot, local)` for all numbers that an operation makes of an instance.
  void each_result(const Op& op, int instance, const int* index, auto&& visit) const {
    for (int s = 0; s < op.stride; ++s) {
      if (slots(instance)[s].kind == result_of(op.phase)) visit(index[s], s);
    }
  }

  bool any_read(int instance, int local, const int* index, const std::vector<bool>& marked) const {
    return std::ranges::any_of(object(instance).reads[local],
                               [&](int s) { return slots(instance)[s].numeric() && marked[index[s]]; });
  }

  /// What may change at a hit or on the way to it, what changes on the way, and what jumps at the hit.
  void find_varying() {
    const Layout& layout = plan_.layout;
    for (int s = layout.first_state; s < layout.first_held; ++s) varies_[s] = moves_[s] = true;
    varies_[0] = moves_[0] = true;
    for (int s = layout.first_held; s < layout.first_output; ++s) varies_[s] = sampled(plan_.owner[s]);
    for (const Op& op : plan_.sweep.ops) {
      each(op, [&](int, int instance, const int* index) {
        each_result(op, instance, index, [&](int slot, int local) {
          const bool latched = op.rate >= 0;
          varies_[slot] = varies_[slot] || latched || any_read(instance, local, index, varies_);
          moves_[slot] = moves_[slot] || (!latched && any_read(instance, local, index, moves_));
          jumps_[slot] = jumps_[slot] || latched || any_read(instance, local, index, jumps_);
        });
      });
    }
  }

  bool relations_and_alarms_stand_still() const {
    const auto moves = [&](int slot) { return moves_[slot]; };
    if (std::ranges::any_of(plan_.located_relations, moves)) return false;
    return std::ranges::all_of(plan_.alarm_records, [&](const AlarmRecord& alarm) {
      const int instance = alarm.instance;
      const auto still = [&](int s) {
        const SlotKind kind = slots(instance)[s].kind;
        return kind == SlotKind::param || kind == SlotKind::held;
      };
      return !sampled(instance) &&
             std::ranges::all_of(object(instance).reads[plan_.owner_local[alarm.slot]], still);
    });
  }

  /// From what has to be there back to what it is made of. In sorted order one pass does, but for blocks that
  /// are called on several levels.
  void find_computed() {
    for (const Op& op : plan_.rates.ops) {
      if (op.phase == Phase::outputs) each(op, [&](int place, int, const int*) { in_rates_[place] = true; });
    }
    for (const LogColumn& column : plan_.columns) needed_[column.slot] = true;
    for (const int slot : plan_.frozen) needed_[slot] = true;
    for (bool again = true; again;) {
      again = false;
      for (auto op = plan_.sweep.ops.rbegin(); op != plan_.sweep.ops.rend(); ++op) {
        each(*op, [&](int place, int instance, const int* index) {
          if (!is_wanted(*op, place, instance, index)) return;
          again = again || !computed_[place];
          computed_[place] = true;
          for (int s = 0; s < op->stride; ++s) {
            if (slots(instance)[s].kind == SlotKind::input) needed_[index[s]] = true;
          }
        });
      }
    }
  }

  bool is_wanted(const Op& op, int place, int instance, const int* index) const {
    if (op.rate >= 0 || computed_[place]) return true;
    bool varies = false, needed = false;
    each_result(op, instance, index, [&](int slot, int) {
      varies = varies || varies_[slot];
      needed = needed || needed_[slot];
    });
    return varies && (needed || !in_rates_[place] || op.phase == Phase::relations);
  }

  /// The part of an operation that is computed; a batch may fall into several.
  void append(const Op& op, HitProgram& program) const {
    for (int k = 0; k < op.count; ++k) {
      if (!computed_[op.place + k]) continue;
      Op one = op;
      one.first += k * op.stride;
      one.place += k;
      one.count = 1;
      for (; k + 1 < op.count && computed_[op.place + k + 1]; ++k) ++one.count;
      each(one, [&](int, int instance, const int* index) {
        each_result(one, instance, index, [&](int slot, int) {
          (op.phase == Phase::relations ? program.relations : program.outputs).push_back(slot);
        });
      });
      program.ops.push_back(one);
    }
  }

  void append_handlers(HitProgram& program) const {
    program.first_held = plan_.layout.first_output;
    program.last_held = plan_.layout.first_held;
    for (int rate = 0; rate < static_cast<int>(plan_.hit_rates.size()); ++rate) {
      for (const int instance : plan_.hit_rates[rate].handlers) {
        const int* index = plan_.index_of(instance);
        HitProgram::Handler handler{
            rate, object(instance).self.get(), object(instance).type->kernels.on_double.on_sample, index, {}};
        for (std::size_t s = 0; s < slots(instance).size(); ++s) {
          if (slots(instance)[s].kind != SlotKind::held) continue;
          handler.held.push_back(index[s]);
          program.first_held = std::min(program.first_held, index[s]);
          program.last_held = std::max(program.last_held, index[s] + 1);
        }
        program.handlers.push_back(std::move(handler));
      }
    }
  }

  const Plan& plan_;
  std::vector<bool> varies_, moves_, jumps_, needed_;  // of each slot
  std::vector<bool> in_rates_, computed_;              // of each place
};

}  // namespace

HitProgram make_hit_program(const Plan& plan) { return HitProgramWriter(plan).write(); }

}  // namespace flyball
