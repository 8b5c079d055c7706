#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "solvers/simulator.h"
#include "studies/metrics/assessment.h"

namespace flyball {

/// How a run ended.
enum class RunStatus { finished, stopped, interrupted };

/// "finished", "stopped", "interrupted"
std::string to_string(RunStatus status);

/// All that is known after a run, whatever its end: what was logged before an error is there.
struct RunResult {
  std::shared_ptr<const Plan> plan;
  SimulationSettings settings;
  Log log;
  RunStatistics statistics = {};
  MethodReport method = {};
  double max_step = 0.0;   // s
  double end = 0.0;        // simulated time that was reached, s
  double wall_time = 0.0;  // s
  RunStatus status = RunStatus::finished;
  std::optional<Profile> profile = {};
  Assessment assessment = {};  // where it was asked for
  std::string reason = {};     // of a stop, and of an end before the stop time that the model asked for
};

/// Runs a plan once. `progress` gets the part done, from 0 to 1, and interrupts the run by giving false.
/// A SimulationError ends up in the result.
RunResult run_plan(std::shared_ptr<const Plan> plan, const SimulationSettings& settings, LogOptions log = {},
                   const std::function<bool(double)>& progress = {});

/// The same with a profile in the result, whose wall time is without the profiler's.
RunResult profile_plan(std::shared_ptr<const Plan> plan, const SimulationSettings& settings,
                       LogOptions log = {}, const std::function<bool(double)>& progress = {});

}  // namespace flyball
