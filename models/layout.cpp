#include "models/layout.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

namespace flyball {
namespace {

const std::vector<SlotSpec>& slots_of(const Plan& plan, int instance) {
  return plan.instance(instance).object->specification->slots;
}

/// Instances of one object that are first called at the same level stand together, so that a batch is one run
/// of consecutive index maps and consecutive slots.
void place(Plan& plan, const Order& order) {
  const int n = static_cast<int>(plan.diagram->instances.size());
  std::map<const BlockObject*, int> object_number;  // by first use: addresses would not be deterministic
  std::vector<std::tuple<int, int, int>> key(n);
  for (int i = 0; i < n; ++i) {
    const BlockObject* object = plan.instance(i).object.get();
    const int number = object_number.emplace(object, static_cast<int>(object_number.size())).first->second;
    int level = std::numeric_limits<int>::max();
    for (int s = 0; s < static_cast<int>(slots_of(plan, i).size()); ++s) {
      if (order.level(order.node(i, s)) >= 0) level = std::min(level, order.level(order.node(i, s)));
    }
    key[i] = {level, number, i};
  }
  plan.placed.resize(n);
  std::iota(plan.placed.begin(), plan.placed.end(), 0);
  std::ranges::sort(plan.placed, {}, [&](int i) { return key[i]; });
  plan.map.resize(n);
  int first = 0;
  for (const int i : plan.placed) {
    plan.map[i] = first;
    first += static_cast<int>(slots_of(plan, i).size());
  }
  plan.index.assign(first, -1);
}

class SlotGiver {
 public:
  SlotGiver(Plan& plan, const Order& order) : plan_(plan), order_(order) {}

  void run() {
    give(-1, 0);  // time
    parameters();
    Layout& layout = plan_.layout;
    layout.first_state = size();
    kind(SlotKind::state);
    layout.first_held = size();
    kind(SlotKind::held);
    layout.first_output = size();
    kind(SlotKind::output);
    layout.first_relation = size();
    kind(SlotKind::relation);
    layout.first_crossing = size();
    kind(SlotKind::crossing);
    layout.first_alarm = size();
    kind(SlotKind::alarm);
    layout.size = size();
    objects();
    inputs();
  }

 private:
  int size() const { return static_cast<int>(plan_.owner.size()); }

  int give(int instance, int local) {
    plan_.owner.push_back(instance);
    plan_.owner_local.push_back(local);
    return size() - 1;
  }

  int& index(int instance, int local) { return plan_.index[plan_.map[instance] + local]; }

  void bind(int slot, const Binding& binding) {
    if (binding.kind == Binding::Kind::literal) {
      plan_.literals.push_back({slot, binding.value, -1});
    } else if (binding.kind == Binding::Kind::formula) {
      Derivation derivation{slot, binding.formula.get(), {}};
      for (const int operand : binding.operands) derivation.operands.push_back(model_slot_[operand]);
      plan_.derivations.push_back(std::move(derivation));
    }
  }

  void parameters() {
    const auto& all = plan_.diagram->parameters;
    for (int p = 0; p < static_cast<int>(all.size()); ++p) {
      const bool alias = all[p].binding.kind == Binding::Kind::parameter;
      model_slot_.push_back(alias ? model_slot_[all[p].binding.parameter] : give(-1, p + 1));
      if (!alias) bind(model_slot_[p], all[p].binding);
    }
    plan_.model_slots = model_slot_;
    for (const int i : plan_.placed) {
      index(i, 0) = 0;
      for (const auto& [local, binding] : plan_.instance(i).parameters) {
        if (binding.kind == Binding::Kind::parameter) {
          index(i, local) = model_slot_[binding.parameter];
        } else {
          bind(index(i, local) = give(i, local), binding);
          if (slots_of(plan_, i)[local].stream) plan_.streams.push_back(index(i, local));
        }
      }
      for (const auto& [local, from] : plan_.instance(i).inputs) open_input(i, local, from);
    }
  }

  /// An optional input that is left open is a constant of its own.
  void open_input(int i, int local, Endpoint from) {
    const SlotSpec& spec = slots_of(plan_, i)[local];
    if (from.connected() || !spec.numeric()) return;
    index(i, local) = give(i, local);
    plan_.literals.push_back({index(i, local), spec.fallback, -1});
  }

  void kind(SlotKind kind) {
    for (const int i : plan_.placed) {
      const auto& slots = slots_of(plan_, i);
      for (int s = 0; s < static_cast<int>(slots.size()); ++s) {
        if (slots[s].kind != kind || order_.source(i, s).connected()) continue;
        index(i, s) = give(i, s);
        if (kind == SlotKind::state || kind == SlotKind::held || slots[s].initial_param >= 0) {
          const int from = slots[s].initial_param < 0 ? -1 : index(i, slots[s].initial_param);
          plan_.initial.push_back({index(i, s), slots[s].fallback, from});
        }
        if (slots[s].end != RunEnd::none) plan_.run_ends.push_back(index(i, s));
        if (kind == SlotKind::crossing) plan_.crossing_records.push_back({i, s, slots[s].direction});
        if (kind == SlotKind::alarm) plan_.alarm_records.push_back({i, index(i, s)});
      }
    }
  }

  void objects() {
    for (const int i : plan_.placed) {
      const auto& slots = slots_of(plan_, i);
      for (int s = 0; s < static_cast<int>(slots.size()); ++s) {
        if (slots[s].kind == SlotKind::object_output) {
          index(i, s) = plan_.layout.objects++;
          plan_.first_objects.push_back(slots[s].make_object);
        } else if (slots[s].kind == SlotKind::memory) {
          index(i, s) = plan_.layout.memories++;
          plan_.first_memories.push_back(slots[s].make_memory);
        }
      }
    }
  }

  /// Inputs, and outputs that are an input, stand for their source's slot.
  void inputs() {
    for (const int i : plan_.placed) {
      for (int s = 0; s < static_cast<int>(slots_of(plan_, i).size()); ++s) {
        const Endpoint from = order_.source(i, s);
        if (from.connected()) index(i, s) = index(from.instance, from.slot);
      }
    }
  }

  Plan& plan_;
  const Order& order_;
  std::vector<int> model_slot_;
};

}  // namespace

void lay_out(Plan& plan, const Order& order) {
  place(plan, order);
  SlotGiver(plan, order).run();
  for (const Guess& guess : plan.diagram->guesses) {
    plan.initial.push_back({plan.index_of(guess.of.instance)[guess.of.slot], guess.value, -1});
  }
  for (const Logged& logged : plan.diagram->logged) {
    plan.columns.push_back(
        {logged.name, logged.unit, plan.index_of(logged.source.instance)[logged.source.slot]});
  }
}

}  // namespace flyball
