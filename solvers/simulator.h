#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "solvers/asked_times.h"
#include "solvers/discrete_step.h"
#include "solvers/exact_step.h"
#include "solvers/instant.h"
#include "solvers/log.h"
#include "solvers/method.h"
#include "solvers/parameters.h"
#include "solvers/profile.h"
#include "solvers/regular_hits.h"
#include "solvers/step_polynomial.h"
#include "solvers/stepper.h"

namespace flyball {

struct LogOptions {
  bool enabled = true;
  EventRows event_rows = EventRows::both;
  std::vector<double> times =
      {};  // [s], ascending: rows there instead of at SimulationSettings::log_interval
};

/// What a run did, for its summary and the result's metadata.
struct RunStatistics {
  StepperStatistics stepper;
  long hits = 0;          // instants with at least one sampled block
  long regular_hits = 0;  // of these, the ones that took RegularHits
  long alarms = 0;
  long events = 0;  // relations and crossings that fired
};

/// Tolerances and step limits, with their defaults.
StepperOptions stepper_options(const SimulationSettings& settings);

/// Why a run ends when this held value of Plan::run_ends is no longer 0.
std::string end_reason(const Plan& plan, int slot);

/// Runs one plan in one workspace: steps, finds events, carries out instants, logs.
class Simulator {
 public:
  Simulator(std::shared_ptr<const Plan> plan, const SimulationSettings& settings, LogOptions log = {});
  /// Goes on from a checkpoint: a copy of the workspace of another simulator of the same plan.
  Simulator(std::shared_ptr<const Plan> plan, const SimulationSettings& settings,
            Workspace<double> checkpoint, LogOptions log = {});
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;

  /// One accepted step and, where one is due, the instant at its end. False at the stop time.
  /// Throws SimulationError; what was logged stays.
  bool advance();

  /// Why the run ended before the stop time, in words; empty when it did not.
  std::string end_reason() const;

  /// Runs to the stop time. `progress` gets the part done, from 0 to 1, and stops the run by giving false.
  void run(const std::function<bool(double)>& progress = {});

  double time() const { return time_; }
  /// Valid between calls of `advance`; a copy is a checkpoint.
  const Workspace<double>& workspace() const { return workspace_; }
  const Plan& plan() const { return *plan_; }
  const Log& log() const { return log_; }
  RunStatistics statistics() const;
  /// The method that runs now, and the longest step that is allowed.
  MethodReport method() const { return report_method(method_, *plan_, settings_, workspace_.step); }
  double max_step() const { return options_.max_step; }

  /// Has each step from now on seen by a profiler that outlives the run.
  void profile_with(Profiler& profiler) { profiler_ = &profiler; }
  /// What a profiler has seen, with the counts of this run.
  Profile profile(const Profiler& profiler) const;

  /// Sets a parameter before the run begins: "K" or "block.parameter", SI. Throws std::invalid_argument when
  /// there is none, when it is structural or derived, or when the value is out of range.
  void set_parameter(std::string_view name, double value);
  /// The same for several at once, by slots that may be set (`settable_parameter`).
  void set_parameters(const ParameterSet& set);

  /// Tells `listener` what each instant does; it must outlive the run.
  void tell(InstantListener& listener) { instant_.tell(listener); }

 private:
  enum class Stage { fresh, resumed, running };
  Simulator(std::shared_ptr<const Plan> plan, const SimulationSettings& settings, Workspace<double> workspace,
            LogOptions log, Stage stage);

  void begin();
  double next_tick() const;
  long run_regular_hits();
  template <class Method>
  long run_regular_hits(Method& method);
  double locate(double t0, double t1, double limit, bool& located);
  void instant(double t, double tick, bool located);
  void find_due(double t, double tick, bool located);
  void take_hits();
  void check_alarms(double t) const;
  void find_end();
  void watch_progress(double t);
  void remember(double end, bool located);

  void log_at(double t);
  bool log_as_polynomial(double last);
  void log_asked(double end, bool with_end);
  void log_instant(bool was_asked);

  std::shared_ptr<const Plan> plan_;
  SimulationSettings settings_;
  LogOptions log_options_;
  Stage stage_;
  StepperOptions options_;
  AskedTimes asked_;
  Workspace<double> workspace_;
  PlanSystem system_;
  std::string method_;  // of make_stepper
  Zeros zeros_;
  Instant instant_;
  RegularHits regular_hits_;
  std::unique_ptr<Stepper<double>> stepper_;
  ExactStep* exact_ = nullptr;  // `stepper_`, where it is of this method
  DiscreteStep* discrete_ = nullptr;
  Log log_;
  AffineProgram affine_log_;
  StepPolynomial polynomial_;
  Due due_;
  std::vector<double> row_before_, row_after_;
  double time_;
  double step_end_ = 0.0;  // of the last step, also where an event came before it
  double last_event_ = -1.0;
  int close_events_ = 0;     // located events in a row without progress
  std::vector<int> recent_;  // what fired in them, as Zeros counts
  int ended_by_ = -1;        // slot of the held value that ended the run
  RunStatistics statistics_;
  Profiler* profiler_ = nullptr;
};

}  // namespace flyball
