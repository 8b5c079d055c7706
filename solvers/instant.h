#pragma once

#include <string>
#include <vector>

#include "solvers/plan_system.h"
#include "solvers/sweep.h"
#include "solvers/zeros.h"

namespace flyball {

/// What is due at an instant.
struct Due {
  std::vector<unsigned char> rates;  // of each rate: whether it hits
  std::vector<int> alarms;           // numbers of alarms
  bool hits = false;
  bool located = false;  // `Zeros::found` fired
};

/// What happened at the instants of a run.
struct EventCounts {
  std::vector<long> zeros;   // of each relation and crossing, as Zeros counts: how often it fired
  std::vector<long> alarms;  // of each alarm
  std::vector<long> hits;    // of each rate
  long sweeps = 0;
};

/// The one place where things happen at a point in time, shared by all methods: docs/semantics.md.
class Instant {
 public:
  Instant(const Plan& plan, Workspace<double>& workspace, PlanSystem& system, Zeros& zeros);

  /// Carries out the instant at the time and state that the workspace holds. Returns whether anything changed
  /// that a rate depends on. Throws SimulationError on non-finite values, chattering and alarms in the past.
  bool run(const Due& due);

  /// Asks all schedules; `workspace.values` then holds the times of the alarms.
  void ask_schedules();
  /// The earliest alarm; `never` when none is set.
  double next_alarm() const;

  const EventCounts& counts() const { return counts_; }

 private:
  enum class Method { on_sample, on_time, on_crossing };
  struct Handler {
    int instance;
    Method method;
    int local;  // crossing
  };

  void sweep(const Due* hits);
  void collect_due(const Due& due);
  void collect_crossings(const std::vector<int>& numbers);
  void run_handlers();
  void run_handler(const Handler& handler);
  void run_again(const Handler& handler);
  void check_staged() const;
  bool commit();
  void remember();
  bool states_changed() const;
  bool changed(const std::vector<int>& slots, const std::vector<double>& remembered) const;
  double external(int slot) const;
  [[noreturn]] void throw_endless() const;
  const Instance& instance(int i) const { return plan_.instance(i); }

  const Plan& plan_;
  Workspace<double>& workspace_;
  PlanSystem& system_;
  Zeros& zeros_;
  Sweep sweep_;
  std::vector<int> staged_first_, staged_;  // slots of states and held values of each instance
  std::vector<Handler> handlers_;
  std::vector<unsigned char> is_staged_;  // of each instance, in this round
  std::vector<int> touched_;              // instances staged in this round
  std::vector<double> saved_;
  std::vector<double> states_before_, externals_before_, frozen_before_;
  std::vector<double> rates_;
  EventCounts counts_;
};

}  // namespace flyball
