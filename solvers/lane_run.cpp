#include "solvers/lane_run.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

/// So many located events of one run in a row, each within rounding of the one before, are no motion any
/// more.
constexpr int most_close_events = 50;

/// Whether something that a program evaluates depends on time itself.
bool reads_time(const Program& program) {
  return std::ranges::any_of(program.ops, [](const Op& op) {
    return std::ranges::any_of(
        op.object->reads, [](const std::vector<int>& slots) { return !slots.empty() && slots.front() == 0; });
  });
}

template <Isa isa>
class LaneRunOn final : public LaneRun {
 public:
  LaneRunOn(const Plan& plan, const SimulationSettings& settings, const LogOptions& log)
      : plan_(plan),
        log_options_(log),
        options_(stepper_options(settings)),
        asked_(settings, log.times),
        stop_(settings.stop),
        moves_(plan.layout.states() > 0 || reads_time(plan.zeros)),
        group_(plan),
        stepper_(group_, options_, settings.method == "auto"),
        events_(group_, stepper_),
        instant_(group_, events_),
        ticks_(plan.hit_rates.size()),
        logs_(lane_count, Log(plan)),
        rows_before_(lane_count),
        at_end_(lane_count),
        end_rows_(lane_count),
        last_event_(lane_count),
        close_events_(lane_count) {
    due_.rates.assign(plan.hit_rates.size(), 0);
  }

  void load(int lane, const Workspace<double>& initialised, bool counts) override {
    group_.load(lane, initialised, counts);
    ticks_ = initialised.ticks;
    logs_[lane] = Log(plan_);
    at_end_[lane].clear();
    last_event_[lane] = -1.0;
    close_events_[lane] = 0;
  }

  bool run(const std::function<bool()>& cancelled) override {
    constexpr int steps_between = 256;
    log_position_ = 0;
    ended_ = running_ = false;
    instant_.ask_schedules();
    instant(0.0, next_tick(), false);
    running_ = true;
    stepper_.restart(true);
    for (int k = 1; group_.active() != 0 && time_ < stop_; ++k) {
      if (cancelled && k % steps_between == 0 && cancelled()) return false;
      advance();
    }
    group_.drop_bad_outputs();
    return true;
  }

  bool finished(int lane) const override { return runs(lane) || has_ended(lane); }
  double value(int slot, int lane) const override {
    return has_ended(lane) ? at_end_[lane][slot] : group_.values[slot].lane(lane);
  }
  Log take_log(int lane) override { return std::move(logs_[lane]); }
  const std::vector<double>& end_row(int lane) override {
    if (has_ended(lane)) return end_rows_[lane];
    if (!ended_) group_.run(group_.logs);
    ended_ = true;
    read(lane, row_);
    return row_;
  }

 private:
  using T = Lanes<isa>;

  bool runs(int lane) const { return ((group_.active() >> lane) & 1u) != 0; }
  bool has_ended(int lane) const { return !at_end_[lane].empty(); }
  void advance();
  double next_tick() const;
  void instant(double t, double tick, bool located);
  void find_due(double t, double tick, bool located);
  void check_alarms(double t);
  void watch_progress(double t);
  LaneMask ending() const;
  void end(LaneMask lanes);
  bool logs() const { return log_options_.enabled && !plan_.columns.empty(); }
  void log_asked(double end, bool with_end);
  void log_here();
  void read(int lane, std::vector<double>& row) const;
  void log_instant(bool was_asked, LaneMask ending);

  const Plan& plan_;
  LogOptions log_options_;
  StepperOptions options_;
  AskedTimes asked_;
  double stop_;
  bool moves_;  // whether something can happen between two instants
  LaneGroup<isa> group_;
  LaneStepper<isa> stepper_;
  LaneEvents<isa> events_;
  LaneInstant<isa> instant_;
  std::vector<std::int64_t> ticks_;  // of each rate: base tick of its next hit
  LaneDue due_;
  std::vector<Log> logs_;
  std::vector<std::vector<double>> rows_before_;  // of each lane; empty where none is asked for
  std::vector<double> row_;
  std::vector<std::vector<double>> at_end_,
      end_rows_;  // values, and what is logged, of runs that a block ended
  std::vector<double> last_event_;
  std::vector<int> close_events_;  // located events in a row without progress
  std::int64_t log_position_ = 0;
  double time_ = 0.0;
  bool running_ = false;
  bool ended_ = false;  // the group shows what is logged at the end
};

template <Isa isa>
void LaneRunOn<isa>::advance() {
  const double tick = next_tick();
  const double first = std::min(tick, instant_.next_alarm());
  const double due = tick - first <= same_instant(first) ? tick : first;
  const double limit = std::min(due, stop_);
  const double t1 = stepper_.step(limit);
  if (group_.active() == 0) return;
  double end = t1;
  const bool located = moves_ && !events_.none() && events_.changed();
  if (located) {
    end = events_.locate(time_, t1);
    if (t1 >= limit && limit - end <= same_instant(limit)) events_.found_at(end = t1);
  }
  if (moves_) group_.drop_bad_outputs();
  const bool is_instant = located || end >= due;
  if (logs()) {
    log_asked(end, !is_instant);
    stepper_.interpolate(end);
  }
  if (is_instant) {
    instant(end, tick, located);
  } else {
    time_ = end;
  }
}

template <Isa isa>
double LaneRunOn<isa>::next_tick() const {
  if (ticks_.empty()) return never;
  const auto k = static_cast<double>(*std::ranges::min_element(ticks_));
  return k * static_cast<double>(plan_.base_tick.numerator()) /
         static_cast<double>(plan_.base_tick.denominator());
}

template <Isa isa>
void LaneRunOn<isa>::instant(double t, double tick, bool located) {
  const bool was_asked = logs() && asked_.is(log_position_, t);
  const bool jumps = logs() && running_ && log_options_.event_rows != EventRows::none;
  if (jumps) group_.run(group_.logs);
  for (int lane = 0; logs() && lane < lane_count; ++lane) {
    rows_before_[lane].clear();
    if (jumps) read(lane, rows_before_[lane]);
  }
  find_due(t, tick, located);
  if (located) watch_progress(t);
  instant_.run(due_);
  time_ = t;
  check_alarms(t);
  const LaneMask ends = ending();
  if (logs()) log_instant(was_asked, ends);
  end(ends);
  if (running_ && t < stop_) stepper_.restart(false);
}

/// The runs that a block ends now. One that ends with an error runs on its own, which tells why.
template <Isa isa>
LaneMask LaneRunOn<isa>::ending() const {
  LaneMask all = 0;
  for (const int slot : plan_.run_ends) {
    for (int lane = 0; lane < lane_count; ++lane) {
      if (group_.values[slot].lane(lane) != 0.0) all |= static_cast<LaneMask>(1u << lane);
    }
  }
  return all & group_.active();
}

template <Isa isa>
void LaneRunOn<isa>::end(LaneMask lanes) {
  if (lanes == 0) return;
  group_.run(group_.logs);
  for (int lane = 0; lane < lane_count; ++lane) {
    if (((lanes >> lane) & 1u) == 0) continue;
    const bool fails = std::ranges::any_of(plan_.run_ends, [&](int slot) {
      const auto& slots = plan_.instance(plan_.owner[slot]).object->specification->slots;
      return slots[plan_.owner_local[slot]].end == RunEnd::error && group_.values[slot].lane(lane) != 0.0;
    });
    for (std::size_t s = 0; !fails && s < group_.values.size(); ++s)
      at_end_[lane].push_back(group_.values[s].lane(lane));
    read(lane, end_rows_[lane]);
  }
  group_.drop(lanes);
}

template <Isa isa>
void LaneRunOn<isa>::find_due(double t, double tick, bool located) {
  due_.located = located;
  due_.hits = tick <= t;
  std::ranges::fill(due_.rates, 0);
  if (due_.hits) {
    const std::int64_t now = *std::ranges::min_element(ticks_);
    for (std::size_t r = 0; r < due_.rates.size(); ++r) {
      due_.rates[r] = ticks_[r] == now ? 1 : 0;
      if (due_.rates[r] != 0) ticks_[r] += plan_.hit_rates[r].period_ticks;
    }
  }
  due_.alarms.clear();
  for (int k = 0; k < static_cast<int>(plan_.alarm_records.size()); ++k) {
    const T& alarm = group_.values[plan_.alarm_records[k].slot];
    LaneMask lanes = 0;
    for (int lane = 0; lane < lane_count; ++lane) {
      if (alarm.lane(lane) <= t + same_instant(t)) lanes |= static_cast<LaneMask>(1u << lane);
    }
    if (lanes != 0) due_.alarms.push_back({k, lanes});
  }
}

template <Isa isa>
void LaneRunOn<isa>::check_alarms(double t) {
  for (const AlarmRecord& alarm : plan_.alarm_records) {
    for (int lane = 0; lane < lane_count; ++lane) {
      if (!(group_.values[alarm.slot].lane(lane) > t)) group_.drop(static_cast<LaneMask>(1u << lane));
    }
  }
}

template <Isa isa>
void LaneRunOn<isa>::watch_progress(double t) {
  LaneMask fired = 0;
  for (const auto& change : events_.found()) fired |= change.lanes;
  for (int lane = 0; lane < lane_count; ++lane) {
    if (((fired >> lane) & 1u) == 0) continue;
    const bool close = t - last_event_[lane] <= 1e-10 * options_.max_step + same_instant(t);
    last_event_[lane] = t;
    close_events_[lane] = close ? close_events_[lane] + 1 : 1;
    if (close_events_[lane] > most_close_events) group_.drop(static_cast<LaneMask>(1u << lane));
  }
}

template <Isa isa>
void LaneRunOn<isa>::read(int lane, std::vector<double>& row) const {
  row.assign(1, group_.time());
  for (const LogColumn& column : plan_.columns) row.push_back(group_.values[column.slot].lane(lane));
}

/// A row of each run at what the group shows.
template <Isa isa>
void LaneRunOn<isa>::log_here() {
  group_.run(group_.logs);
  for (int lane = 0; lane < lane_count; ++lane) {
    if (!runs(lane)) continue;
    read(lane, row_);
    if (!logs_[lane].append(row_[0], row_.data() + 1)) group_.drop(static_cast<LaneMask>(1u << lane));
  }
}

template <Isa isa>
void LaneRunOn<isa>::log_asked(double end, bool with_end) {
  const double last = with_end ? end : end - same_instant(end);
  double logged = -1.0;
  for (double t = asked_.time(log_position_); t <= last; t = asked_.time(++log_position_)) {
    stepper_.interpolate(logged = t);
    log_here();
  }
  if (!with_end || end < stop_ || logged >= end) return;
  stepper_.interpolate(end);
  log_here();
}

/// The rows of an instant: both sides of a jump, one where the signals are continuous and the time was asked
/// for.
template <Isa isa>
void LaneRunOn<isa>::log_instant(bool was_asked, LaneMask ending) {
  if (was_asked) ++log_position_;
  for (int lane = 0; lane < lane_count; ++lane) {
    if (!runs(lane)) continue;
    read(lane, row_);
    const bool last = time_ >= stop_ || ((ending >> lane) & 1u) != 0;
    const bool jump = !rows_before_[lane].empty() && rows_before_[lane] != row_;
    if (jump && log_options_.event_rows == EventRows::both) logs_[lane].append_row(rows_before_[lane]);
    if (jump || was_asked || last) logs_[lane].append_row(row_);
  }
}

}  // namespace

std::unique_ptr<LaneRun> LaneRun::make(Isa isa, const Plan& plan, const SimulationSettings& settings,
                                       const LogOptions& log) {
  if (isa == Isa::avx2) return std::make_unique<LaneRunOn<Isa::avx2>>(plan, settings, log);
  return std::make_unique<LaneRunOn<Isa::baseline>>(plan, settings, log);
}

}  // namespace flyball
