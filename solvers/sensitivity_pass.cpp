#include "solvers/sensitivity_pass.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solvers/cvode_jets.h"
#include "solvers/dormand_prince.h"

namespace flyball {
namespace {

/// A signal that passes its threshold this much slower than it came there only touches it: the time of the
/// event then hangs on the last digits of the signal.
constexpr double grazing = 1e-4;
/// Derivatives of two times closer than this part of either are one: they are the same event.
constexpr double same_derivative = 1e-6;

constexpr int time_direction = SensitivityPass::most_seeds;

std::unique_ptr<Stepper<Jet>> make_stepper(JetSystem& system, const StepperOptions& options, bool stiff) {
  if (stiff && system.size() > 0) return make_bdf_on_jets(system, options);
  return std::make_unique<DormandPrince<Jet>>(system, options);
}

}  // namespace

SensitivityPass::SensitivityPass(const Plan& plan, const StepperOptions& options, bool stiff,
                                 SensitivityTable& table)
    : plan_(plan),
      table_(table),
      jets_(plan),
      system_(plan, jets_, names_),
      stepper_(make_stepper(system_, options, stiff)),
      handlers_(plan, jets_),
      flow_(plan.layout.states()) {}

void SensitivityPass::start(const Workspace<double>& run, std::vector<SensitivitySeed> seeds) {
  run_ = &run;
  seeds_ = std::move(seeds);
  names_.clear();
  lost_.assign(seeds_.size(), false);
  lift(run, jets_);
  for (std::size_t d = 0; d < seeds_.size(); ++d) {
    names_.push_back(seeds_[d].name);
    jets_.values[seeds_[d].slot].v[static_cast<int>(d)] = seeds_[d].scale;
  }
  initialise(plan_, jets_);
  time_ = 0.0;
  running_ = false;
  next_ = 0;
}

void SensitivityPass::integrate(double t) {
  while (time_ < t) {
    const double end = stepper_->step(Jet(t), jets_.step).a;
    // What is asked for at an instant is recorded behind it.
    const double last = std::min(end, t - same_instant(t));
    for (; next_ < table_.times.size() && table_.times[next_] < last; ++next_) {
      jets_.values[0] = Jet(table_.times[next_]);
      stepper_->interpolate(jets_.values[0], system_.states());
      record(next_);
    }
    time_ = end;
  }
  system_.place(Jet(t), stepper_->state());
}

void SensitivityPass::finish(double stop) {
  integrate(stop);
  record_instant();
}

void SensitivityPass::begins(const Due& due, const Zeros& zeros, const Approach& approach) {
  const double t = run_->values[0];
  early_.clear();
  early_hits_ = false;
  causes_.clear();
  if (!running_) return begin_at_start(due);
  integrate(t);
  for (int s = plan_.layout.first_state; s < plan_.layout.first_held; ++s)
    jets_.values[s].a = run_->values[s];
  find_causes(due, zeros, approach);
  for (const Cause& cause : causes_) {
    if (!same_time(cause, causes_.back())) play_early(cause, due, zeros);
  }
  shift_to_instant(causes_.back().time);
}

/// The start does not move: an alarm that has come by then happens at 0, wherever it was set.
void SensitivityPass::begin_at_start(const Due& due) {
  run(plan_.schedules, plan_, frame(plan_, jets_));
  for (const int k : due.alarms) {
    const Jet& alarm = jets_.values[plan_.alarm_records[k].slot];
    for (std::size_t d = 0; d < seeds_.size(); ++d) {
      if (alarm.a == 0.0 && alarm.v[static_cast<int>(d)] != 0.0)
        warn(SensitivityWarning::Kind::one_sided, static_cast<int>(d),
             fmt::format("{} is at the start of the run", plan_.slot_name(plan_.alarm_records[k].slot)));
    }
  }
}

void SensitivityPass::find_causes(const Due& due, const Zeros& zeros, const Approach& approach) {
  if (due.hits) causes_.push_back({Cause::Kind::ticks, -1, Derivatives::Zero()});
  for (const int k : due.alarms) {
    const Derivatives time = jets_.values[plan_.alarm_records[k].slot].v;
    causes_.push_back({Cause::Kind::alarm, k, time});
  }
  if (!due.located) return;
  find_slopes();
  for (const int k : zeros.found())
    causes_.push_back({Cause::Kind::zero, k, zero_time(zeros.slot(k), approach)});
}

/// Relations and crossings with their derivatives by the parameters at this time, and along the flow.
void SensitivityPass::find_slopes() {
  Jet* x = system_.states();
  system_.rates(jets_.values[0], x, flow_.data());
  jets_.values[0].v[time_direction] = 1.0;
  for (int i = 0; i < system_.size(); ++i) x[i].v[time_direction] = flow_[i].a;
  run(plan_.zeros, plan_, frame(plan_, jets_));
  jets_.values[0].v[time_direction] = 0.0;
  for (int i = 0; i < system_.size(); ++i) x[i].v[time_direction] = 0.0;
}

/// dt/dp = -(dz/dp)/(dz/dt).
SensitivityPass::Derivatives SensitivityPass::zero_time(int slot, const Approach& approach) {
  const Jet z = jets_.values[slot];
  const double slope = z.v[time_direction];
  const double came_from = approach.zeros[slot - plan_.layout.first_relation];
  const double came_with = std::fabs(came_from) / (jets_.values[0].a - approach.time);
  const bool touches = slope == 0.0 || std::fabs(slope) < grazing * came_with;
  Derivatives time = Derivatives::Zero();
  for (int d = 0; d < static_cast<int>(seeds_.size()); ++d) {
    if (z.v[d] == 0.0) continue;
    if (touches) {
      lose(d, slot);
    } else {
      time[d] = -z.v[d] / slope;
    }
  }
  return time;
}

/// From here on there is no derivative along a direction; zeros go on in its place.
void SensitivityPass::lose(int direction, int slot) {
  if (lost_[direction]) return;
  lost_[direction] = true;
  for (Jet& x : jets_.values) x.v[direction] = 0.0;
  warn(SensitivityWarning::Kind::grazing, direction, plan_.slot_name(slot) + " only touches its threshold");
}

bool SensitivityPass::same_time(const Cause& a, const Cause& b) const {
  const double rounding = same_instant(jets_.values[0].a);
  return ((a.time - b.time).array().abs() <=
          rounding + same_derivative * a.time.array().abs().max(b.time.array().abs()))
      .all();
}

/// Plays what the parameters would part from the rest of the instant before it: ticks, then alarms, then
/// what was located.
void SensitivityPass::play_early(const Cause& cause, const Due& due, const Zeros& zeros) {
  const Cause& rest = causes_.back();
  for (std::size_t d = 0; d < seeds_.size(); ++d) {
    if (cause.time[static_cast<int>(d)] == rest.time[static_cast<int>(d)]) continue;
    warn(SensitivityWarning::Kind::one_sided, static_cast<int>(d),
         fmt::format("{} and {} are at one time", name(cause, zeros), name(rest, zeros)));
  }
  shift_to_instant(cause.time);
  const bool is_relation = cause.kind == Cause::Kind::zero && zeros.is_relation(cause.number);
  if (is_relation) jets_.bits[zeros.number(cause.number)] ^= 1;
  early_hits_ = early_hits_ || cause.kind == Cause::Kind::ticks;
  sweep(cause.kind == Cause::Kind::ticks ? &due : nullptr, &zeros);
  collect_calls(cause, due, zeros);
  early_.insert(early_.end(), calls_.begin(), calls_.end());
  commit_calls();
  sweep(nullptr, &zeros);
  shift_back();
}

void SensitivityPass::collect_calls(const Cause& cause, const Due& due, const Zeros& zeros) {
  calls_.clear();
  if (cause.kind == Cause::Kind::alarm) {
    calls_.push_back({plan_.alarm_records[cause.number].instance, HandlerCall::Method::on_time});
  } else if (cause.kind == Cause::Kind::zero && !zeros.is_relation(cause.number)) {
    const CrossingRecord& crossing = plan_.crossing_records[zeros.number(cause.number)];
    calls_.push_back({crossing.instance, HandlerCall::Method::on_crossing, crossing.local});
  }
  for (std::size_t r = 0; cause.kind == Cause::Kind::ticks && r < due.rates.size(); ++r) {
    if (due.rates[r] == 0) continue;
    for (const int i : plan_.hit_rates[r].handlers) calls_.push_back({i, HandlerCall::Method::on_sample});
  }
}

/// What runs on double alone is not run again: its values are taken from the run.
void SensitivityPass::commit_calls() {
  std::erase_if(calls_, [&](const HandlerCall& call) {
    return !plan_.instance(call.instance).object->type->differentiable;
  });
  handlers_.run(calls_);
  stale_ = handlers_.commit();
}

std::string SensitivityPass::name(const Cause& cause, const Zeros& zeros) const {
  if (cause.kind == Cause::Kind::ticks) return "a sample hit";
  if (cause.kind == Cause::Kind::zero) return zeros.name(cause.number);
  return "alarm " + plan_.slot_name(plan_.alarm_records[cause.number].slot);
}

/// From derivatives at a fixed time to derivatives at the moving time of the instant.
void SensitivityPass::shift_to_instant(const Derivatives& time) {
  shift_ = time;
  if (shift_.isZero(0.0)) return;
  Jet* x = system_.states();
  system_.rates(jets_.values[0], x, flow_.data());
  for (int i = 0; i < system_.size(); ++i) x[i].v += flow_[i].a * shift_;
  jets_.values[0].v = shift_;
}

void SensitivityPass::shift_back() {
  if (shift_.isZero(0.0)) return;
  Jet* x = system_.states();
  system_.rates(jets_.values[0], x, flow_.data());
  for (int i = 0; i < system_.size(); ++i) x[i].v -= flow_[i].a * shift_;
  jets_.values[0].v.setZero();
  shift_.setZero();
}

void SensitivityPass::swept(const Due* hits) {
  jets_.bits = run_->bits;
  sweep(early_hits_ ? nullptr : hits);
  stale_ = false;
}

/// With `settle_beside`, bits settle by value, but for those that were located in this instant.
void SensitivityPass::sweep(const Due* hits, const Zeros* settle_beside) {
  if (plan_.layout.objects > 0) jets_.objects = run_->objects;
  const Program& program = plan_.sweep;
  int done = 0;
  for (const LoopSpan& span : program.loops) {
    call_all({done, span.first}, hits, settle_beside);
    solve_loop({plan_, program, span, hits == nullptr ? nullptr : &hits->rates}, frame(plan_, jets_),
               jets_.loops);
    done = span.last;
  }
  call_all({done, static_cast<int>(program.ops.size())}, hits, settle_beside);
}

void SensitivityPass::call_all(std::pair<int, int> ops, const Due* hits, const Zeros* settle_beside) {
  const auto f = frame(plan_, jets_);
  for (int at = ops.first; at < ops.second; ++at) {
    const Op& op = plan_.sweep.ops[at];
    if (op.rate >= 0 && (hits == nullptr || hits->rates[op.rate] == 0)) continue;
    if (op.object->type->differentiable) {
      call(op, plan_, f);
    } else {
      take_outputs(op);
    }
    for (int k = op.settle_first; settle_beside != nullptr && k < op.settle_first + op.settle_count; ++k)
      settle(plan_.sweep.settle[k], *settle_beside);
  }
}

void SensitivityPass::settle(int slot, const Zeros& located) {
  const auto same = [&](int k) { return located.slot(k) == slot; };
  if (std::ranges::any_of(located.found(), same)) return;
  unsigned char& bit = jets_.bits[slot - plan_.layout.first_relation];
  const double z = jets_.values[slot].a;
  if (bit != 0 ? z < 0.0 : z > 0.0) bit = z > 0.0 ? 1 : 0;
}

void SensitivityPass::take_outputs(const Op& op) {
  const auto& slots = op.object->specification->slots;
  for (int k = 0; k < op.count * op.stride; ++k) {
    const SlotSpec& spec = slots[k % op.stride];
    if (!spec.numeric()) continue;
    const int slot = plan_.index[op.first + k];
    if (spec.kind == SlotKind::output) jets_.values[slot] = Jet(run_->values[slot]);
    for (int d = 0; d < static_cast<int>(seeds_.size()); ++d) {
      if (jets_.values[slot].v[d] != 0.0)
        warn(SensitivityWarning::Kind::opaque, d,
             plan_.instance(plan_.placed[op.place + k / op.stride]).name + " passes no derivative on");
    }
  }
}

void SensitivityPass::handled(const std::vector<HandlerCall>& calls) {
  calls_ = calls;
  std::erase_if(calls_,
                [&](const HandlerCall& call) { return std::ranges::find(early_, call) != early_.end(); });
  early_.clear();
  commit_calls();
}

void SensitivityPass::ends() {
  if (stale_) sweep(nullptr);
  run(plan_.schedules, plan_, frame(plan_, jets_));
  for (std::size_t s = 0; s < jets_.values.size(); ++s) jets_.values[s].a = run_->values[s];
  shift_back();
  time_ = run_->values[0];
  running_ = true;
  stepper_->restart(Jet(time_), system_.states(), jets_.step, true);
  record_instant();
}

void SensitivityPass::record_instant() {
  const double last = time_ + same_instant(time_);
  for (; next_ < table_.times.size() && table_.times[next_] <= last; ++next_) record(next_);
}

void SensitivityPass::record(std::size_t k) {
  run(plan_.logs, plan_, frame(plan_, jets_));
  const std::size_t signals = table_.slots.size();
  for (std::size_t s = 0; s < signals; ++s) {
    const Jet& y = jets_.values[table_.slots[s]];
    system_.require_finite(y, jets_.values[0].a, plan_.slot_name(table_.slots[s]));
    table_.values[k * signals + s] = y.a;
    double* row = table_.derivatives.data() + (k * signals + s) * table_.parameters;
    for (std::size_t d = 0; d < seeds_.size(); ++d) {
      const double derivative = y.v[static_cast<int>(d)] / seeds_[d].scale;
      row[seeds_[d].parameter] = lost_[d] ? std::numeric_limits<double>::quiet_NaN() : derivative;
    }
  }
}

void SensitivityPass::warn(SensitivityWarning::Kind kind, int direction, const std::string& what) {
  static constexpr const char* consequences[] = {"there is no derivative by {} from then on",
                                                 "the derivative by {} is one-sided",
                                                 "the derivative by {} leaves out what goes through it"};
  const SensitivitySeed& seed = seeds_[direction];
  const bool known = std::ranges::any_of(table_.warnings, [&](const SensitivityWarning& w) {
    return w.kind == kind && w.parameter == seed.parameter && w.message.starts_with(what);
  });
  if (known) return;
  const double t = run_->values[0];
  const std::string message =
      fmt::format("{} at t = {} s: {}", what, t,
                  fmt::format(fmt::runtime(consequences[static_cast<int>(kind)]), seed.name));
  table_.warnings.push_back({kind, t, seed.parameter, message});
}

}  // namespace flyball
