#pragma once

#include <string>
#include <vector>

#include "solvers/handlers.h"
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

/// Hears what an instant does, while it does it: who repeats a run on another scalar listens.
class InstantListener {
 public:
  virtual ~InstantListener() = default;
  /// Before anything has happened; what was located is in Zeros::found.
  virtual void begins(const Due& due, const Zeros& zeros) = 0;
  /// After a sweep; `hits` are null when sampled blocks were left out.
  virtual void swept(const Due* hits) = 0;
  /// After the handlers ran, before what they staged is committed.
  virtual void handled(const std::vector<HandlerCall>& calls) = 0;
  virtual void ends() = 0;
};

/// The one place where things happen at a point in time, shared by all methods: docs/semantics.md.
class Instant {
 public:
  Instant(const Plan& plan, Workspace<double>& workspace, PlanSystem& system, Zeros& zeros);

  /// Carries out the instant at the time and state that the workspace holds. Returns whether anything changed
  /// that a rate depends on. Throws SimulationError on non-finite values, chattering and alarms in the past.
  bool run(const Due& due);

  /// Tells `listener` from now on; it must outlive all instants.
  void tell(InstantListener& listener) { listener_ = &listener; }

  /// Asks all schedules; `workspace.values` then holds the times of the alarms.
  void ask_schedules();
  /// The earliest alarm; `never` when none is set.
  double next_alarm() const;

  bool is_heard() const { return listener_ != nullptr; }

  const EventCounts& counts() const { return counts_; }
  /// Counts the sweep and the hits of an instant that RegularHits carries out.
  void count_hits(const Due& due) {
    ++counts_.sweeps;
    for (std::size_t r = 0; r < counts_.hits.size(); ++r) counts_.hits[r] += due.rates[r];
  }

 private:
  void sweep(const Due* hits);
  void collect_due(const Due& due);
  void collect_crossings(const std::vector<int>& numbers);
  bool run_handlers();
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
  Handlers<double> handlers_;
  std::vector<HandlerCall> calls_;
  InstantListener* listener_ = nullptr;
  std::vector<double> states_before_, externals_before_, frozen_before_;
  std::vector<double> rates_;
  EventCounts counts_;
};

}  // namespace flyball
