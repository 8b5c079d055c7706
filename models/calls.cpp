#include "models/calls.h"

#include <algorithm>

namespace flyball {

void append_call(const Plan& plan, Program& program, Phase phase, int place, bool may_join) {
  const int instance = plan.placed[place];
  const BlockObject& what = *plan.instance(instance).object;
  const bool after_loop = !program.loops.empty() && program.loops.back().last == std::ssize(program.ops);
  if (may_join && !after_loop && !program.ops.empty()) {
    Op& last = program.ops.back();
    // Objects are shared by structure, the sample time included, so one object has one rate.
    if (last.object == &what && last.phase == phase && last.place + last.count == place) {
      ++last.count;
      return;
    }
  }
  Op op;
  op.object = &what;
  op.self = what.self.get();
  op.phase = phase;
  op.on_double = what.type->kernels.on_double.sweep(phase);
  op.on_jet = what.type->kernels.on_jet.sweep(phase);
  op.first = plan.map[instance];
  op.stride = static_cast<int>(what.specification->slots.size());
  op.count = 1;
  op.place = place;
  op.rate = plan.rate_of[instance];
  program.ops.push_back(op);
}

namespace {

class LoopWriter {
 public:
  LoopWriter(const Plan& plan, const Order& order, const Knot& knot) : plan_(plan), order_(order) {
    for (const int tear : knot.tears) {
      const Endpoint e = order.endpoint(tear);
      tears_.push_back(e);
      const int slot = plan.index_of(e.instance)[e.slot];
      result_.tears.push_back({slot, plan.rate_of[e.instance]});
      result_.guessed = result_.guessed || is_guessed(slot);
    }
  }

  void call(int member, const std::vector<int>& place_of) {
    const Endpoint e = order_.endpoint(member);
    if (e.instance != instance_ || reads_last_call(e)) {
      // Within a batch no guess could be put back.
      const bool may_join = !owns_tear(e.instance) && (instance_ < 0 || !owns_tear(instance_));
      append_call(plan_, body_, Phase::outputs, place_of[e.instance], may_join);
      evaluated_.clear();
      instance_ = e.instance;
      put_back();
    }
    evaluated_.push_back(e);
    for (Loop::Return& back : result_.returns) {
      const bool last_call = back.op == static_cast<int>(body_.ops.size()) - 1;
      back.final = back.final || (last_call && tears_[back.tear] == e);
    }
  }

  LoopCalls finish() {
    for (const Op& op : body_.ops) {
      const auto& slots = op.object->specification->slots;
      for (int s = 0; s < op.stride; ++s) {
        result_.affine = result_.affine && (slots[s].kind != SlotKind::output || op.object->affine[s]);
      }
      for (int k = 0; k < op.count * op.stride; ++k) {
        if (slots[k % op.stride].numeric()) result_.slots.push_back(plan_.index[op.first + k]);
      }
    }
    std::ranges::sort(result_.slots);
    result_.slots.erase(std::unique(result_.slots.begin(), result_.slots.end()), result_.slots.end());
    return {std::move(result_), std::move(body_.ops)};
  }

 private:
  bool is_guessed(int slot) const {
    return std::ranges::any_of(plan_.diagram->guesses, [&](const Guess& guess) {
      return plan_.index_of(guess.of.instance)[guess.of.slot] == slot;
    });
  }

  bool owns_tear(int instance) const {
    return std::ranges::any_of(tears_, [&](Endpoint tear) { return tear.instance == instance; });
  }

  /// One call gives several outputs of an instance, unless one of them needs another.
  bool reads_last_call(Endpoint e) const {
    bool found = false;
    order_.behind(e.instance, plan_.instance(e.instance).object->reads[e.slot], [&](Endpoint from) {
      found = found || std::ranges::find(evaluated_, from) != evaluated_.end();
    });
    return found;
  }

  void put_back() {
    for (std::size_t k = 0; k < tears_.size(); ++k) {
      if (tears_[k].instance != instance_) continue;
      result_.returns.push_back({static_cast<int>(body_.ops.size()) - 1, static_cast<int>(k), false});
    }
  }

  const Plan& plan_;
  const Order& order_;
  std::vector<Endpoint> tears_;
  std::vector<Endpoint> evaluated_;  // by the last call
  int instance_ = -1;                // of the last call
  Program body_;
  Loop result_;
};

}  // namespace

LoopCalls write_loop(const Plan& plan, const Order& order, const Knot& knot,
                     const std::vector<int>& place_of) {
  LoopWriter writer(plan, order, knot);
  for (const int member : knot.members) writer.call(member, place_of);
  return writer.finish();
}

}  // namespace flyball
