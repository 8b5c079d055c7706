#include "solvers/instant.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "solvers/errors.h"

namespace flyball {
namespace {

constexpr int most_rounds = 50;

}  // namespace

Instant::Instant(const Plan& plan, Workspace<double>& workspace, PlanSystem& system, Zeros& zeros)
    : plan_(plan),
      workspace_(workspace),
      system_(system),
      zeros_(zeros),
      sweep_(plan, workspace, zeros),
      is_staged_(plan.placed.size(), 0),
      states_before_(plan.layout.states()),
      externals_before_(plan.externals.size()),
      frozen_before_(plan.frozen.size()),
      rates_(plan.layout.states()) {
  counts_.zeros.resize(static_cast<std::size_t>(zeros.size()));
  counts_.alarms.resize(plan.alarm_records.size());
  counts_.hits.resize(plan.hit_rates.size());
  staged_first_.push_back(0);
  for (int i = 0; i < static_cast<int>(plan.placed.size()); ++i) {
    const auto& slots = instance(i).object->specification->slots;
    for (int s = 0; s < static_cast<int>(slots.size()); ++s) {
      const bool staged = slots[s].kind == SlotKind::state || slots[s].kind == SlotKind::held;
      if (staged) staged_.push_back(plan.index_of(i)[s]);
    }
    staged_first_.push_back(static_cast<int>(staged_.size()));
  }
  std::size_t most = plan.alarm_records.size() + plan.crossing_records.size();
  for (const Rate& rate : plan.hit_rates) most += rate.handlers.size();
  handlers_.reserve(most);
  touched_.reserve(most);
}

bool Instant::run(const Due& due) {
  remember();
  if (due.located) zeros_.force();
  sweep(&due);
  collect_due(due);
  run_handlers();
  bool again = commit();
  for (int round = 0; again || plan_.layout.crossings() > 0; ++round) {
    if (round == most_rounds) throw_endless();
    if (again) sweep(nullptr);
    handlers_.clear();
    collect_crossings(zeros_.fired_crossings());
    if (handlers_.empty()) break;
    run_handlers();
    again = commit();
  }
  if (changed(plan_.frozen, frozen_before_))
    workspace_.rates_map.stale = workspace_.zeros_map.stale = workspace_.logs_map.stale = true;
  const bool rearm = zeros_.must_rearm();
  if (rearm || system_.must_learn()) system_.rates_after_sweep(rates_.data());
  zeros_.adopt_sweep();
  if (rearm) zeros_.rearm(rates_.data(), system_);
  zeros_.release();
  ask_schedules();
  return states_changed() || changed(plan_.externals, externals_before_);
}

void Instant::sweep(const Due* hits) {
  ++counts_.sweeps;
  sweep_.run(hits == nullptr ? nullptr : &hits->rates);
  if (!outputs_are_finite(plan_, workspace_))
    throw_first_bad({&plan_.sweep}, plan_, workspace_, hits != nullptr);
}

void Instant::collect_due(const Due& due) {
  handlers_.clear();
  for (std::size_t r = 0; due.hits && r < plan_.hit_rates.size(); ++r) {
    if (due.rates[r] == 0) continue;
    ++counts_.hits[r];
    for (const int i : plan_.hit_rates[r].handlers) handlers_.push_back({i, Method::on_sample, 0});
  }
  for (const int k : due.alarms) {
    ++counts_.alarms[k];
    handlers_.push_back({plan_.alarm_records[k].instance, Method::on_time, 0});
  }
  if (!due.located) return;
  for (const int k : zeros_.found()) {
    ++counts_.zeros[k];
    if (zeros_.is_relation(k)) continue;
    const CrossingRecord& crossing = plan_.crossing_records[zeros_.number(k)];
    handlers_.push_back({crossing.instance, Method::on_crossing, crossing.local});
  }
}

void Instant::collect_crossings(const std::vector<int>& numbers) {
  for (const int k : numbers) {
    handlers_.push_back(
        {plan_.crossing_records[k].instance, Method::on_crossing, plan_.crossing_records[k].local});
    ++counts_.zeros[zeros_.position_of_crossing(k)];
  }
}

void Instant::run_handlers() {
  for (const Handler& handler : handlers_) {
    const int i = handler.instance;
    if (is_staged_[i] != 0) {
      run_again(handler);
      continue;
    }
    is_staged_[i] = 1;
    touched_.push_back(i);
    for (int k = staged_first_[i]; k < staged_first_[i + 1]; ++k) {
      workspace_.next[staged_[k] - plan_.layout.first_state] = workspace_.values[staged_[k]];
    }
    run_handler(handler);
  }
}

/// A second handler of one block sees what its first one staged, while all others still see this sweep.
void Instant::run_again(const Handler& handler) {
  const int first = staged_first_[handler.instance], last = staged_first_[handler.instance + 1];
  saved_.clear();
  for (int k = first; k < last; ++k) {
    saved_.push_back(workspace_.values[staged_[k]]);
    workspace_.values[staged_[k]] = workspace_.next[staged_[k] - plan_.layout.first_state];
  }
  run_handler(handler);
  for (int k = first; k < last; ++k) workspace_.values[staged_[k]] = saved_[k - first];
}

void Instant::run_handler(const Handler& handler) {
  const BlockObject& object = *instance(handler.instance).object;
  const Kernels<double>& kernels = object.type->kernels.on_double;
  const Frame<double> f = frame(plan_, workspace_);
  const int* index = plan_.index_of(handler.instance);
  switch (handler.method) {
    case Method::on_sample:
      return kernels.on_sample(object.self.get(), f, index);
    case Method::on_time:
      return kernels.on_time(object.self.get(), f, index);
    case Method::on_crossing:
      return kernels.on_crossing(object.self.get(), f, index, handler.local);
  }
}

/// Before anything is committed, so that the message shows what the handler read.
void Instant::check_staged() const {
  for (const int i : touched_) {
    for (int k = staged_first_[i]; k < staged_first_[i + 1]; ++k) {
      const double next = workspace_.next[staged_[k] - plan_.layout.first_state];
      if (!std::isfinite(next)) throw_bad_next(staged_[k], next, plan_, workspace_);
    }
  }
}

/// Whether anything changed that an unsampled block can see: a sampled block's held values show at its hits
/// only.
bool Instant::commit() {
  check_staged();
  bool visible = false;
  for (const int i : touched_) {
    is_staged_[i] = 0;
    for (int k = staged_first_[i]; k < staged_first_[i + 1]; ++k) {
      const double next = workspace_.next[staged_[k] - plan_.layout.first_state];
      double& value = workspace_.values[staged_[k]];
      if (next != value && (plan_.rate_of[i] < 0 || staged_[k] < plan_.layout.first_held)) visible = true;
      value = next;
    }
  }
  touched_.clear();
  for (std::size_t k = 0; k < workspace_.next_objects.size(); ++k) {
    if (workspace_.next_objects[k] != nullptr) workspace_.objects[k] = std::move(workspace_.next_objects[k]);
  }
  return visible;
}

void Instant::ask_schedules() {
  if (plan_.layout.alarms() == 0) return;
  flyball::run(plan_.schedules, plan_, frame(plan_, workspace_));
  for (const AlarmRecord& alarm : plan_.alarm_records) {
    if (std::isnan(workspace_.values[alarm.slot]))
      throw_first_bad({&plan_.schedules}, plan_, workspace_, true);
  }
}

double Instant::next_alarm() const {
  double first = never;
  for (const AlarmRecord& alarm : plan_.alarm_records) first = std::min(first, workspace_.values[alarm.slot]);
  return first;
}

double Instant::external(int slot) const {
  const int relation = slot - plan_.layout.first_relation;
  return relation >= 0 ? static_cast<double>(workspace_.bits[relation]) : workspace_.values[slot];
}

void Instant::remember() {
  const auto keep = [&](const std::vector<int>& slots, std::vector<double>& values) {
    std::ranges::transform(slots, values.begin(), [&](int slot) { return external(slot); });
  };
  const auto states = workspace_.values.begin() + plan_.layout.first_state;
  std::copy_n(states, plan_.layout.states(), states_before_.begin());
  keep(plan_.externals, externals_before_);
  keep(plan_.frozen, frozen_before_);
}

bool Instant::states_changed() const {
  return !std::equal(states_before_.begin(), states_before_.end(),
                     workspace_.values.begin() + plan_.layout.first_state);
}

bool Instant::changed(const std::vector<int>& slots, const std::vector<double>& remembered) const {
  return !std::ranges::equal(slots, remembered, {}, [&](int slot) { return external(slot); });
}

void Instant::throw_endless() const {
  std::string names;
  for (const Handler& handler : handlers_) {
    const auto& slots = instance(handler.instance).object->specification->slots;
    names += fmt::format("{}{}.{}", names.empty() ? "" : ", ", instance(handler.instance).name,
                         slots[handler.local].name);
  }
  throw SimulationError(SimulationError::Kind::chattering, workspace_.values[0],
                        fmt::format("chattering at t = {} s: after {} rounds these crossings still fire: {}",
                                    workspace_.values[0], most_rounds, names));
}

}  // namespace flyball
