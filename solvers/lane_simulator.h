#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "solvers/log.h"
#include "solvers/parameters.h"
#include "solvers/simulator.h"

namespace flyball {

class LaneRun;

struct LaneOptions {
  LogOptions log{.enabled = false};
  bool end_row = false;  // without a log: a log of the row at the end alone
  int threads = 1;
  std::optional<Isa> isa = std::nullopt;  // else the widest that this machine supports
  std::function<bool()> cancelled = {};   // looked at now and then, from each thread
};

/// What one of many runs sets.
struct LaneInput {
  ParameterSet parameters;
  std::optional<std::uint64_t> seed = {};  // of random numbers; else that of the settings
};

/// How one of many runs ended.
struct LaneOutcome {
  std::vector<double> values;  // the value array at the end
  std::optional<Log> log;      // where it was asked for
  bool alone = false;          // it ran on its own, as Simulator runs it
  bool refused = false;        // a parameter is out of range: there was no run
  bool cancelled = false;      // before its end
  std::string error;           // why it had to stop; empty where it did not
  std::string end_reason;      // of a run that the model ended before the stop time
  double end = 0.0;            // simulated time that was reached [s]
  RunStatistics statistics;    // of a run that went alone: a group has its own
};

/// Why runs of this plan cannot go in lockstep; empty where they can.
std::string refuses_lanes(const Plan& plan, const SimulationSettings& settings);

/// Carries out runs of one plan, a group after the other. The bytes of a group's outcomes depend on the group
/// alone, whatever instruction set there is. Where lockstep is refused, and where one run of a group fails
/// or, with the method auto, turns stiff, runs go one by one.
class LaneSimulator {
 public:
  LaneSimulator(std::shared_ptr<const Plan> plan, const SimulationSettings& settings, LaneOptions options);
  ~LaneSimulator();

  /// At most `lane_count` runs in lockstep. Their parameters are such that may be set (`require_settable`).
  std::vector<LaneOutcome> run(std::span<const LaneInput> group);
  /// One run as Simulator runs it.
  LaneOutcome run_alone(const LaneInput& input) const;

 private:
  bool begin(const LaneInput& input, Workspace<double>& workspace) const;
  std::optional<LaneOutcome> outcome_of(int lane) const;

  std::shared_ptr<const Plan> plan_;
  SimulationSettings settings_;
  LaneOptions options_;
  Workspace<double> fresh_;         // what a run begins with before its parameters are set
  std::unique_ptr<LaneRun> group_;  // none where lockstep is refused
};

/// Runs a plan once for each set of parameters, `lane_count` neighbours of the list at a time as a group of
/// LaneSimulator. The same list gives the same numbers with any number of threads. Throws
/// std::invalid_argument where a parameter cannot be set.
std::vector<LaneOutcome> run_in_lanes(const std::shared_ptr<const Plan>& plan,
                                      const SimulationSettings& settings, std::span<const ParameterSet> sets,
                                      const LaneOptions& options = {});

}  // namespace flyball
