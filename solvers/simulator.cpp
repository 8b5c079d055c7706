#include "solvers/simulator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "solvers/chattering.h"
#include "solvers/parameters.h"
#include "solvers/reach.h"

namespace flyball {
namespace {

/// So many located events in a row, each within rounding of the one before, are no motion any more.
constexpr int most_close_events = 50;

/// What the block that owns a slot said of it.
const SlotSpec& slot_spec(const Plan& plan, int slot) {
  return plan.instance(plan.owner[slot]).object->specification->slots[plan.owner_local[slot]];
}

std::vector<int> logged_slots(const Plan& plan) {
  std::vector<int> slots;
  for (const LogColumn& column : plan.columns) slots.push_back(column.slot);
  return slots;
}

}  // namespace

StepperOptions stepper_options(const SimulationSettings& settings) {
  StepperOptions options;
  options.rtol = settings.rtol;
  options.atol = settings.atol;
  options.max_step = settings.max_step.value_or(settings.stop / 50.0);
  options.fixed_step = settings.step.value_or(settings.stop / 1000.0);
  return options;
}

Simulator::Simulator(std::shared_ptr<const Plan> plan, const SimulationSettings& settings, LogOptions log)
    : Simulator(plan, settings, Workspace<double>(*plan), std::move(log), Stage::fresh) {}

Simulator::Simulator(std::shared_ptr<const Plan> plan, const SimulationSettings& settings,
                     Workspace<double> checkpoint, LogOptions log)
    : Simulator(std::move(plan), settings, std::move(checkpoint), std::move(log), Stage::resumed) {}

Simulator::Simulator(std::shared_ptr<const Plan> plan, const SimulationSettings& settings,
                     Workspace<double> workspace, LogOptions log, Stage stage)
    : plan_(std::move(plan)),
      settings_(settings),
      log_options_(std::move(log)),
      stage_(stage),
      options_(stepper_options(settings)),
      asked_(settings, log_options_.times),
      workspace_(std::move(workspace)),
      system_(*plan_, workspace_),
      method_(first_method(*plan_, system_, settings)),
      zeros_(*plan_, workspace_),
      instant_(*plan_, workspace_, system_, zeros_),
      regular_hits_(*plan_, workspace_, zeros_),
      stepper_(make_stepper(method_, system_, options_)),
      log_(*plan_),
      affine_log_(*plan_, plan_->logs, logged_slots(*plan_)),
      polynomial_(log_.width()),
      time_(workspace_.values[0]) {
  exact_ = dynamic_cast<ExactStep*>(stepper_.get());
  discrete_ = dynamic_cast<DiscreteStep*>(stepper_.get());
  due_.rates.assign(plan_->hit_rates.size(), 0);
  due_.alarms.reserve(plan_->alarm_records.size());
  recent_.reserve(2 * most_close_events);
  row_before_.reserve(plan_->columns.size() + 1);
  row_after_.resize(plan_->columns.size() + 1);
  if (log_options_.enabled) log_.reserve(asked_.count(settings.stop));
}

void Simulator::begin() {
  if (stage_ == Stage::fresh) {
    seed(*plan_, workspace_, settings_.seed);
    initialise(*plan_, workspace_);
    instant_.ask_schedules();
    instant(0.0, next_tick(), false);
  }
  find_end();
  stage_ = Stage::running;
  stepper_->restart(time_, workspace_.values.data() + plan_->layout.first_state, workspace_.step, true);
}

double Simulator::next_tick() const {
  if (workspace_.ticks.empty()) return never;
  const auto k = static_cast<double>(*std::ranges::min_element(workspace_.ticks));
  return k * static_cast<double>(plan_->base_tick.numerator()) /
         static_cast<double>(plan_->base_tick.denominator());
}

bool Simulator::advance() {
  if (stage_ != Stage::running) begin();
  if (time_ >= settings_.stop || ended_by_ >= 0) return false;
  const double tick = next_tick();
  const double alarm = instant_.next_alarm();
  const double first = std::min(tick, alarm);
  const double due = tick - first <= same_instant(first) ? tick : first;
  const double limit = std::min(due, settings_.stop);
  bool located = false;
  double end = step_end_ = stepper_->step(limit, workspace_.step);
  if (profiler_ != nullptr) profiler_->step({time_, end, limit}, *stepper_, workspace_);
  if (!zeros_.none()) end = locate(time_, end, limit, located);
  const bool evaluated = system_.rates_give_outputs() || !zeros_.none();
  if (evaluated && !outputs_are_finite(*plan_, workspace_))
    throw_first_bad({&plan_->rates, &plan_->zeros}, *plan_, workspace_);
  if (!plan_->steps.ops.empty()) remember(end, located);
  const bool is_instant = located || end >= due;
  log_asked(end, !is_instant);
  double* x = workspace_.values.data() + plan_->layout.first_state;
  workspace_.values[0] = end;
  if (located) {
    stepper_->interpolate(end, x);
  } else {
    system_.place(end, stepper_->state());
  }
  if (is_instant) {
    instant(end, tick, located);
  } else {
    time_ = end;
  }
  return time_ < settings_.stop && ended_by_ < 0;
}

/// The end of the step, or the first event in it.
double Simulator::locate(double t0, double t1, double limit, bool& located) {
  const bool after_rates = stepper_->ends_with_rates() && system_.rates_give_outputs();
  if (!after_rates) system_.place(t1, stepper_->state());
  if (zeros_.changed(after_rates).empty()) return t1;
  located = true;
  const double found = zeros_.locate(t0, t1, *stepper_);
  if (t1 < limit || limit - found > same_instant(limit)) return found;
  zeros_.found_at(t1, *stepper_);
  return t1;
}

void Simulator::instant(double t, double tick, bool located) {
  const bool logs = log_options_.enabled && !log_.columns().empty();
  const bool was_asked = logs && asked_.is(workspace_.log_position, t);
  const bool jumps = logs && stage_ == Stage::running && log_options_.event_rows != EventRows::none;
  row_before_.clear();
  if (jumps) {
    flyball::run(plan_->logs, *plan_, frame(*plan_, workspace_));
    log_.read(workspace_.values, row_before_);
  }
  find_due(t, tick, located);
  if (located) watch_progress(t);
  const bool changed = instant_.run(due_);
  flyball::run(plan_->steps, *plan_, frame(*plan_, workspace_));
  if (logs && affine_log_.applies() && workspace_.logs_map.stale)
    affine_log_.adopt(workspace_, workspace_.logs_map);
  time_ = t;
  check_alarms(t);
  find_end();
  if (logs) log_instant(was_asked);
  if (ended_by_ >= 0 && slot_spec(*plan_, ended_by_).end == RunEnd::error) {
    throw SimulationError(SimulationError::Kind::asserted, t, fmt::format("{} at t = {} s", end_reason(), t));
  }
  if (stage_ == Stage::running && t < settings_.stop) {
    stepper_->restart(t, workspace_.values.data() + plan_->layout.first_state, workspace_.step, changed);
  }
}

/// Tells blocks that remember what they read along the step: a polynomial through these points has the order
/// of the continuous extension.
void Simulator::remember(double end, bool located) {
  constexpr int pieces = 4;
  double* x = workspace_.values.data() + plan_->layout.first_state;
  for (int k = 1; k <= pieces; ++k) {
    const bool at_end = k == pieces;
    const double t = at_end ? end : time_ + (end - time_) * k / pieces;
    if (at_end && !located) {
      system_.place(t, stepper_->state());
    } else {
      stepper_->interpolate(t, x);
      workspace_.values[0] = t;
    }
    flyball::run(plan_->steps, *plan_, frame(*plan_, workspace_));
  }
}

void Simulator::find_due(double t, double tick, bool located) {
  due_.located = located;
  due_.hits = false;
  if (tick <= t) {
    take_hits();
  } else {
    std::ranges::fill(due_.rates, 0);
  }
  due_.alarms.clear();
  for (std::size_t k = 0; k < plan_->alarm_records.size(); ++k) {
    if (workspace_.values[plan_->alarm_records[k].slot] > t + same_instant(t)) continue;
    due_.alarms.push_back(static_cast<int>(k));
    ++statistics_.alarms;
  }
}

/// What hits at the next tick.
void Simulator::take_hits() {
  const std::int64_t now = *std::ranges::min_element(workspace_.ticks);
  for (std::size_t r = 0; r < due_.rates.size(); ++r) {
    due_.rates[r] = workspace_.ticks[r] == now ? 1 : 0;
    if (due_.rates[r] != 0) workspace_.ticks[r] += plan_->hit_rates[r].period_ticks;
  }
  due_.hits = true;
  ++statistics_.hits;
}

void Simulator::check_alarms(double t) const {
  for (const AlarmRecord& alarm : plan_->alarm_records) {
    if (workspace_.values[alarm.slot] > t) continue;
    throw SimulationError(SimulationError::Kind::alarm, t,
                          fmt::format("{} asks to be woken at t = {} s, which is not after t = {} s",
                                      plan_->slot_name(alarm.slot), workspace_.values[alarm.slot], t));
  }
}

/// An error counts before an end that was asked for.
void Simulator::find_end() {
  for (const int slot : plan_->run_ends) {
    if (workspace_.values[slot] == 0.0) continue;
    if (ended_by_ < 0 || slot_spec(*plan_, slot).end == RunEnd::error) ended_by_ = slot;
  }
}

std::string end_reason(const Plan& plan, int slot) {
  return fmt::format("{}: {}", plan.instance(plan.owner[slot]).name, slot_spec(plan, slot).doc);
}

std::string Simulator::end_reason() const {
  return ended_by_ < 0 ? std::string() : flyball::end_reason(*plan_, ended_by_);
}

void Simulator::watch_progress(double t) {
  const bool close = t - last_event_ <= 1e-10 * options_.max_step + same_instant(t);
  last_event_ = t;
  if (!close) {
    close_events_ = 0;
    recent_.clear();
  }
  for (const int k : zeros_.found()) {
    if (std::ranges::find(recent_, k) == recent_.end()) recent_.push_back(k);
  }
  if (++close_events_ > most_close_events) throw chattering(t, close_events_, recent_, *plan_, zeros_);
}

/// A row from inside the last step.
void Simulator::log_at(double t) {
  double* x = workspace_.values.data() + plan_->layout.first_state;
  stepper_->interpolate(t, x);
  if (affine_log_.applies()) {
    affine_log_.evaluate(t, x, row_after_.data(), workspace_, workspace_.logs_map);
    if (log_.append(t, row_after_.data())) return;
  }
  workspace_.values[0] = t;
  flyball::run(plan_->logs, *plan_, frame(*plan_, workspace_));
  if (!log_.append(workspace_.values)) throw_first_bad({&plan_->logs}, *plan_, workspace_);
}

/// Many rows of one step at once. False when the step has few, or is not of this kind.
bool Simulator::log_as_polynomial(double last) {
  constexpr std::int64_t worth_it = 8;
  std::int64_t& k = workspace_.log_position;
  if (asked_.time(k + worth_it) > last || !affine_log_.applies()) return false;
  const auto extension = stepper_->extension();
  if (!extension) return false;
  if (workspace_.logs_map.stale) log_at(asked_.time(k++));
  polynomial_.fit(workspace_.logs_map, *extension);
  for (double t = asked_.time(k); t <= last; t = asked_.time(++k)) {
    for (int c = 0; c < polynomial_.signals(); ++c) row_after_[c] = polynomial_.value(c, t);
    if (!log_.append(t, row_after_.data())) log_at(t);
  }
  return true;
}

void Simulator::log_asked(double end, bool with_end) {
  if (!log_options_.enabled || log_.columns().empty()) return;
  const double last = with_end ? end : end - same_instant(end);
  if (!log_as_polynomial(last)) {
    std::int64_t& k = workspace_.log_position;
    for (double t = asked_.time(k); t <= last; t = asked_.time(++k)) log_at(t);
  }
  if (!with_end || end < settings_.stop || (log_.rows() > 0 && log_.time(log_.rows() - 1) >= end)) return;
  log_at(end);
}

/// The rows of an instant: both sides of a jump, one where the signals are continuous and the time was asked
/// for.
void Simulator::log_instant(bool was_asked) {
  if (was_asked) ++workspace_.log_position;
  if (was_asked && row_before_.empty()) {
    log_.append(workspace_.values);
    return;
  }
  log_.read(workspace_.values, row_after_);
  const bool jump = !row_before_.empty() && row_before_ != row_after_;
  if (jump && log_options_.event_rows == EventRows::both) log_.append_row(row_before_);
  if (jump || was_asked || time_ >= settings_.stop || ended_by_ >= 0) log_.append_row(row_after_);
}

void Simulator::run(const std::function<bool(double)>& progress) {
  constexpr long steps_between = 256;
  long steps = 0, told = 0;
  for (bool more = true; more;) {
    steps += run_regular_hits();
    more = advance();
    if (!progress || !more || ++steps - told < steps_between) continue;
    told = steps;
    if (!progress(time_ / settings_.stop)) return;
  }
  if (progress) progress(1.0);
}

/// Takes hits as long as nothing else happens, and leaves what comes then to `advance`, which brings all of
/// the workspace up to date. Returns how many it took.
long Simulator::run_regular_hits() {
  if (stage_ != Stage::running || profiler_ != nullptr || instant_.is_heard() || !regular_hits_.applies())
    return 0;
  if (exact_ != nullptr) return run_regular_hits(*exact_);
  return discrete_ != nullptr ? run_regular_hits(*discrete_) : 0;
}

template <class Method>
long Simulator::run_regular_hits(Method& method) {
  constexpr long most = 1000;  // so that progress is told
  const double end = std::min(instant_.next_alarm(), settings_.stop);
  const bool logs = log_options_.enabled && !log_.columns().empty();
  const bool jumps = logs && regular_hits_.logs_jump() && log_options_.event_rows != EventRows::none;
  double* x = workspace_.values.data() + plan_->layout.first_state;
  due_.alarms.clear();
  due_.located = false;
  row_before_.clear();
  double asked = logs ? asked_.time(workspace_.log_position) : never;
  long done = 0;
  for (double t = next_tick(); done < most; t = next_tick(), ++done) {
    const double blur = same_instant(t);
    const bool is_next = t + blur < end && asked >= t - blur;
    if (!is_next || !reach(options_.max_step, t - time_, options_.max_step).lands) break;
    if (done == 0) regular_hits_.begin();
    step_end_ = method.step(t, workspace_.step);
    system_.place(t, method.state());
    if (jumps) {
      row_before_.clear();
      flyball::run(plan_->logs, *plan_, frame(*plan_, workspace_));
      log_.read(workspace_.values, row_before_);
    }
    take_hits();
    ++statistics_.regular_hits;
    instant_.count_hits(due_);
    const bool switched = regular_hits_.run(due_, method.largest());
    time_ = t;
    const bool was_asked = asked <= t + blur;
    if (logs) log_instant(was_asked);
    if (was_asked) asked = asked_.time(workspace_.log_position);
    switched ? method.restart(t, x, workspace_.step, true) : method.hold();
  }
  if (done > 0) workspace_.rates_map.stale = workspace_.zeros_map.stale = workspace_.logs_map.stale = true;
  return done;
}

RunStatistics Simulator::statistics() const {
  RunStatistics result = statistics_;
  result.stepper = stepper_->statistics();
  const std::vector<long>& fired = instant_.counts().zeros;
  result.events = std::accumulate(fired.begin(), fired.end(), 0L);
  return result;
}

Profile Simulator::profile(const Profiler& profiler) const {
  const StepperStatistics steps = stepper_->statistics();
  const EventCounts& counts = instant_.counts();
  return profiler.profile({.rates = steps.rate_evaluations,
                           .jacobians = steps.jacobians,
                           .zeros = zeros_.none() ? 0 : zeros_.evaluations(),
                           .logs = static_cast<long>(log_.rows()),
                           .sweeps = counts.sweeps,
                           .hits = counts.hits},
                          counts, zeros_);
}

void Simulator::set_parameter(std::string_view name, double value) {
  set_parameters({{settable_parameter(*plan_, name), value}});
}

void Simulator::set_parameters(const ParameterSet& set) { flyball::set_parameters(*plan_, set, workspace_); }

}  // namespace flyball
