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
      handlers_(plan, workspace),
      states_before_(plan.layout.states()),
      externals_before_(plan.externals.size()),
      frozen_before_(plan.frozen.size()),
      rates_(plan.layout.states()) {
  counts_.zeros.resize(static_cast<std::size_t>(zeros.size()));
  counts_.alarms.resize(plan.alarm_records.size());
  counts_.hits.resize(plan.hit_rates.size());
  std::size_t most = plan.alarm_records.size() + plan.crossing_records.size();
  for (const Rate& rate : plan.hit_rates) most += rate.handlers.size();
  calls_.reserve(most);
}

bool Instant::run(const Due& due) {
  remember();
  if (listener_ != nullptr) listener_->begins(due, zeros_);
  if (due.located) zeros_.force();
  sweep(&due);
  collect_due(due);
  bool again = run_handlers();
  for (int round = 0; again || plan_.layout.crossings() > 0; ++round) {
    if (round == most_rounds) throw_endless();
    if (again) sweep(nullptr);
    calls_.clear();
    collect_crossings(zeros_.fired_crossings());
    if (calls_.empty()) break;
    again = run_handlers();
  }
  if (changed(plan_.frozen, frozen_before_))
    workspace_.rates_map.stale = workspace_.zeros_map.stale = workspace_.logs_map.stale = true;
  const bool rearm = zeros_.must_rearm();
  if (rearm || system_.must_learn()) system_.rates_after_sweep(rates_.data());
  zeros_.adopt_sweep();
  if (rearm) zeros_.rearm(rates_.data(), system_);
  zeros_.release();
  ask_schedules();
  if (listener_ != nullptr) listener_->ends();
  return states_changed() || changed(plan_.externals, externals_before_);
}

void Instant::sweep(const Due* hits) {
  ++counts_.sweeps;
  sweep_.run(hits == nullptr ? nullptr : &hits->rates);
  if (!outputs_are_finite(plan_, workspace_))
    throw_first_bad({&plan_.sweep}, plan_, workspace_, hits != nullptr);
  if (listener_ != nullptr) listener_->swept(hits);
}

void Instant::collect_due(const Due& due) {
  calls_.clear();
  for (std::size_t r = 0; due.hits && r < plan_.hit_rates.size(); ++r) {
    if (due.rates[r] == 0) continue;
    ++counts_.hits[r];
    for (const int i : plan_.hit_rates[r].handlers) calls_.push_back({i, HandlerCall::Method::on_sample, 0});
  }
  for (const int k : due.alarms) {
    ++counts_.alarms[k];
    calls_.push_back({plan_.alarm_records[k].instance, HandlerCall::Method::on_time, 0});
  }
  if (!due.located) return;
  for (const int k : zeros_.found()) {
    ++counts_.zeros[k];
    if (zeros_.is_relation(k)) continue;
    const CrossingRecord& crossing = plan_.crossing_records[zeros_.number(k)];
    calls_.push_back({crossing.instance, HandlerCall::Method::on_crossing, crossing.local});
  }
}

void Instant::collect_crossings(const std::vector<int>& numbers) {
  for (const int k : numbers) {
    ++counts_.zeros[zeros_.position_of_crossing(k)];
    calls_.push_back({plan_.crossing_records[k].instance, HandlerCall::Method::on_crossing,
                      plan_.crossing_records[k].local});
  }
}

/// Runs what was collected and commits. Returns whether an unsampled block can see a change.
bool Instant::run_handlers() {
  handlers_.run(calls_);
  // Before anything is committed, so that the message shows what the handler read.
  const int bad = handlers_.bad_slot();
  if (bad >= 0) throw_bad_next(bad, workspace_.next[bad - plan_.layout.first_state], plan_, workspace_);
  if (listener_ != nullptr) listener_->handled(calls_);
  return handlers_.commit();
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
  for (const HandlerCall& handler : calls_) {
    const auto& slots = instance(handler.instance).object->specification->slots;
    names += fmt::format("{}{}.{}", names.empty() ? "" : ", ", instance(handler.instance).name,
                         slots[handler.local].name);
  }
  throw SimulationError(SimulationError::Kind::chattering, workspace_.values[0],
                        fmt::format("chattering at t = {} s: after {} rounds these crossings still fire: {}",
                                    workspace_.values[0], most_rounds, names));
}

}  // namespace flyball
