#include "solvers/lane_instant.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

constexpr int most_rounds = 50;

}  // namespace

template <Isa isa>
LaneInstant<isa>::LaneInstant(LaneGroup<isa>& group, LaneEvents<isa>& events)
    : group_(group),
      events_(events),
      is_staged_(group.plan.placed.size(), 0),
      alone_(group.plan),
      system_(group.plan, alone_),
      rates_(group.plan.layout.states()) {
  staged_first_.push_back(0);
  for (int i = 0; i < static_cast<int>(group.plan.placed.size()); ++i) {
    const auto& slots = group.plan.instance(i).object->specification->slots;
    for (int s = 0; s < static_cast<int>(slots.size()); ++s) {
      const bool staged = slots[s].kind == SlotKind::state || slots[s].kind == SlotKind::held;
      if (staged) staged_.push_back(group.plan.index_of(i)[s]);
    }
    staged_first_.push_back(static_cast<int>(staged_.size()));
  }
}

template <Isa isa>
void LaneInstant<isa>::run(const LaneDue& due) {
  if (due.located) events_.force();
  const Hits& hits = find_hits(due.hits ? &due : nullptr);
  const bool moves = hits.moves_crossings;
  sweep(hits);
  bool again = false;
  if (due.alarms.empty() && !due.located && !hits.moves_states) {
    sample(hits);
  } else {
    collect_due(due);
    run_handlers();
    again = commit();
  }
  // At the start all crossings are looked at.
  bool looks = group_.plan.layout.crossings() > 0 &&
               (again || due.located || !due.alarms.empty() || moves || group_.time() == 0.0);
  for (int round = 0; again || looks; ++round) {
    if (again) sweep(find_hits(nullptr));
    handlers_.clear();
    collect_crossings(events_.fired_crossings());
    if (round == most_rounds) {
      for (const Handler& handler : handlers_) group_.drop(handler.lanes);
      break;
    }
    if (handlers_.empty()) break;
    run_handlers();
    again = commit();
  }
  rearm();
  events_.release();
  ask_schedules();
}

template <Isa isa>
typename LaneInstant<isa>::Hits LaneInstant<isa>::hits_of(const std::vector<unsigned char>& rates) const {
  const Plan& plan = group_.plan;
  Hits hits;
  hits.rates = rates;
  for (std::size_t k = 0; k < plan.sweep.ops.size(); ++k) {
    const Op& op = plan.sweep.ops[k];
    if (op.rate >= 0 && rates[op.rate] == 0) continue;
    hits.sweeps.push_back({group_.sweep[k], op.settle_first, op.settle_count});
  }
  for (std::size_t r = 0; r < rates.size(); ++r) {
    if (rates[r] == 0) continue;
    for (const int i : plan.hit_rates[r].handlers) {
      hits.samples.push_back(
          {group_.kernels(i).on_sample, plan.instance(i).object->self.get(), plan.index_of(i)});
      for (int k = staged_first_[i]; k < staged_first_[i + 1]; ++k) add_staged(hits, staged_[k]);
    }
  }
  hits.moves_crossings = plan.layout.states() > 0 || moves_crossings(hits);
  return hits;
}

/// Time counts as computed anew.
template <Isa isa>
bool LaneInstant<isa>::moves_crossings(const Hits& hits) const {
  const Plan& plan = group_.plan;
  std::vector<bool> moved(plan.layout.size, false);
  moved[0] = true;
  for (const auto& [call, settle_first, settle_count] : hits.sweeps) {
    for (int k = 0; k < call.count * call.stride; ++k) {
      const int slot = call.index[k];
      if (slot >= plan.layout.first_output && slot < plan.layout.first_crossing) moved[slot] = true;
    }
  }
  return std::ranges::any_of(plan.crossings.ops, [&](const Op& op) {
    const auto& slots = op.object->specification->slots;
    for (int k = 0; k < op.count * op.stride; ++k) {
      const int local = k % op.stride;
      const bool reads = std::ranges::any_of(op.object->reads, [&](const std::vector<int>& read) {
        return std::ranges::binary_search(read, local);
      });
      if (reads && slots[local].numeric() && moved[plan.index[op.first + k]]) return true;
    }
    return false;
  });
}

template <Isa isa>
void LaneInstant<isa>::add_staged(Hits& hits, int slot) const {
  if (slot < group_.plan.layout.first_held) hits.moves_states = true;
  if (!hits.staged.empty() && hits.staged.back().first + hits.staged.back().second == slot) {
    ++hits.staged.back().second;
  } else {
    hits.staged.emplace_back(slot, 1);
  }
}

template <Isa isa>
const typename LaneInstant<isa>::Hits& LaneInstant<isa>::find_hits(const LaneDue* due) {
  const auto same = [&](const Hits& hits) {
    return due != nullptr ? hits.rates == due->rates
                          : std::ranges::all_of(hits.rates, [](unsigned char hit) { return hit == 0; });
  };
  const auto known = std::ranges::find_if(known_hits_, same);
  if (known != known_hits_.end()) return *known;
  // Rates that hit together are few; a diagram with very many of them begins anew.
  constexpr std::size_t most = 64;
  if (known_hits_.size() == most) known_hits_.clear();
  const std::vector<unsigned char> none(group_.plan.hit_rates.size(), 0);
  known_hits_.push_back(hits_of(due != nullptr ? due->rates : none));
  return known_hits_.back();
}

template <Isa isa>
void LaneInstant<isa>::sweep(const Hits& hits) {
  const Frame<T> f = group_.frame();
  for (const auto& sweep : hits.sweeps) {
    LaneGroup<isa>::run(sweep.call, f);
    for (int s = sweep.settle_first; s < sweep.settle_first + sweep.settle_count; ++s)
      events_.settle(group_.plan.sweep.settle[s]);
  }
  group_.drop_bad_outputs();
}

/// Where nothing else is due: samples in all lanes, which no unsampled block sees. What is staged of held
/// values is what they are, until a handler writes it. The next sweep looks whether they are finite.
template <Isa isa>
void LaneInstant<isa>::sample(const Hits& hits) {
  const Frame<T> f = group_.frame();
  for (const auto& sample : hits.samples) sample.kernel(sample.self, f, sample.index);
  for (const auto& [slot, count] : hits.staged)
    std::copy_n(&group_.next[slot - group_.plan.layout.first_state], count, &group_.values[slot]);
}

template <Isa isa>
void LaneInstant<isa>::collect_due(const LaneDue& due) {
  const Plan& plan = group_.plan;
  handlers_.clear();
  for (std::size_t r = 0; due.hits && r < plan.hit_rates.size(); ++r) {
    if (due.rates[r] == 0) continue;
    for (const int i : plan.hit_rates[r].handlers) handlers_.push_back({i, Method::on_sample, 0, all_lanes});
  }
  for (const LaneDue::Alarm& alarm : due.alarms) {
    handlers_.push_back({plan.alarm_records[alarm.number].instance, Method::on_time, 0, alarm.lanes});
  }
  if (due.located) collect_crossings(events_.found());
}

template <Isa isa>
void LaneInstant<isa>::collect_crossings(const std::vector<typename LaneEvents<isa>::Change>& changes) {
  for (const auto& change : changes) {
    if (events_.is_relation(change.watched)) continue;
    const CrossingRecord& crossing = group_.plan.crossing_records[events_.number(change.watched)];
    handlers_.push_back({crossing.instance, Method::on_crossing, crossing.local, change.lanes});
  }
}

/// A second handler of one block sees what its first one staged, while all others still see this sweep.
template <Isa isa>
void LaneInstant<isa>::run_handlers() {
  const int first_state = group_.plan.layout.first_state;
  for (const Handler& handler : handlers_) {
    const int i = handler.instance;
    const int first = staged_first_[i], last = staged_first_[i + 1];
    if (is_staged_[i] == 0) {
      is_staged_[i] = 1;
      touched_.push_back(i);
      for (int k = first; k < last; ++k) group_.next[staged_[k] - first_state] = group_.values[staged_[k]];
    }
    values_before_.clear();
    next_before_.clear();
    for (int k = first; k < last; ++k) {
      values_before_.push_back(group_.values[staged_[k]]);
      next_before_.push_back(group_.next[staged_[k] - first_state]);
      group_.values[staged_[k]] = next_before_.back();
    }
    run_handler(handler);
    for (int k = first; k < last; ++k) {
      T& next = group_.next[staged_[k] - first_state];
      LaneArithmetic<isa>::blend(static_cast<LaneMask>(~handler.lanes & all_lanes), next_before_[k - first],
                                 next);
      group_.values[staged_[k]] = values_before_[k - first];
    }
  }
}

template <Isa isa>
void LaneInstant<isa>::run_handler(const Handler& handler) {
  const Kernels<T>& kernels = group_.kernels(handler.instance);
  const void* self = group_.plan.instance(handler.instance).object->self.get();
  const Frame<T> f = group_.frame();
  const int* index = group_.plan.index_of(handler.instance);
  switch (handler.method) {
    case Method::on_sample:
      return kernels.on_sample(self, f, index);
    case Method::on_time:
      return kernels.on_time(self, f, index);
    case Method::on_crossing:
      return kernels.on_crossing(self, f, index, handler.local);
  }
}

/// Whether anything changed that an unsampled block can see: a sampled block's held values show at its hits
/// only.
template <Isa isa>
bool LaneInstant<isa>::commit() {
  const Layout& layout = group_.plan.layout;
  bool visible = false;
  for (const int i : touched_) {
    is_staged_[i] = 0;
    for (int k = staged_first_[i]; k < staged_first_[i + 1]; ++k) {
      const T& next = group_.next[staged_[k] - layout.first_state];
      T& value = group_.values[staged_[k]];
      group_.drop(static_cast<LaneMask>(~LaneArithmetic<isa>::finite(&next, 1)));
      const bool shows = group_.plan.rate_of[i] < 0 || staged_[k] < layout.first_held;
      if (shows && (group_.active() & ~LaneArithmetic<isa>::equal(next, value)) != 0) visible = true;
      value = next;
    }
  }
  touched_.clear();
  return visible;
}

template <Isa isa>
void LaneInstant<isa>::rearm() {
  const LaneMask lanes = events_.must_rearm();
  for (int lane = 0; lane < lane_count; ++lane) {
    if (((lanes >> lane) & 1u) == 0) continue;
    group_.store(lane, alone_);
    flyball::run(group_.plan.rates_only, group_.plan, flyball::frame(group_.plan, alone_, rates_.data()));
    events_.rearm(lane, system_.zero_rates(rates_.data()));
  }
}

template <Isa isa>
void LaneInstant<isa>::ask_schedules() {
  group_.run(group_.schedules);
  for (const AlarmRecord& alarm : group_.plan.alarm_records) {
    group_.drop(static_cast<LaneMask>(~LaneArithmetic<isa>::ordered(&group_.values[alarm.slot], 1)));
  }
}

template <Isa isa>
double LaneInstant<isa>::next_alarm() const {
  double first = never;
  for (const AlarmRecord& alarm : group_.plan.alarm_records) {
    for (int lane = 0; lane < lane_count; ++lane) {
      if (((group_.active() >> lane) & 1u) != 0)
        first = std::min(first, group_.values[alarm.slot].lane(lane));
    }
  }
  return first;
}

template class LaneInstant<Isa::baseline>;
template class LaneInstant<Isa::avx2>;

}  // namespace flyball
