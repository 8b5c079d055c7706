#include "studies/run.h"

#include <chrono>

#include "solvers/errors.h"

namespace flyball {

std::string to_string(RunStatus status) {
  switch (status) {
    case RunStatus::finished:
      return "finished";
    case RunStatus::stopped:
      return "stopped";
    case RunStatus::interrupted:
      return "interrupted";
  }
  return {};
}

namespace {

using Clock = std::chrono::steady_clock;

/// `start` is when the work on this run began.
RunResult run(Simulator& simulator, std::shared_ptr<const Plan> plan, const SimulationSettings& settings,
              const std::function<bool(double)>& progress, Clock::time_point start) {
  RunResult result{std::move(plan), settings, Log(simulator.plan())};
  const auto watched = [&](double part) {
    if (!progress || progress(part)) return true;
    result.status = RunStatus::interrupted;
    return false;
  };
  try {
    simulator.run(watched);
  } catch (const SimulationError& error) {
    result.status = RunStatus::stopped;
    result.reason = error.what();
  }
  if (result.reason.empty()) result.reason = simulator.end_reason();
  result.wall_time = std::chrono::duration<double>(Clock::now() - start).count();
  result.log = simulator.log();
  result.statistics = simulator.statistics();
  result.method = simulator.method();
  result.max_step = simulator.max_step();
  result.end = simulator.time();
  return result;
}

}  // namespace

RunResult run_plan(std::shared_ptr<const Plan> plan, const SimulationSettings& settings, LogOptions log,
                   const std::function<bool(double)>& progress) {
  const Clock::time_point start = Clock::now();
  Simulator simulator(plan, settings, log);
  return run(simulator, std::move(plan), settings, progress, start);
}

RunResult profile_plan(std::shared_ptr<const Plan> plan, const SimulationSettings& settings, LogOptions log,
                       const std::function<bool(double)>& progress) {
  const Clock::time_point start = Clock::now();
  Simulator simulator(plan, settings, log);
  Profiler profiler(*plan, settings.stop, simulator.max_step());
  simulator.profile_with(profiler);
  RunResult result = run(simulator, std::move(plan), settings, progress, start);
  result.profile = simulator.profile(profiler);
  result.wall_time -= profiler.own_time();
  return result;
}

}  // namespace flyball
