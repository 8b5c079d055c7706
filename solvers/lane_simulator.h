#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "solvers/log.h"
#include "solvers/simulator.h"

namespace flyball {

/// Values of parameters by slot (Plan::parameter_slot), SI.
using ParameterSet = std::vector<std::pair<int, double>>;

struct LaneOptions {
  LogOptions log{.enabled = false};
  int threads = 1;
  std::optional<Isa> isa = std::nullopt;  // else the widest that this machine supports
};

/// How one of many runs ended.
struct LaneOutcome {
  std::vector<double> values;  // the value array at the stop time
  std::optional<Log> log;      // where it was asked for
  bool alone = false;          // it ran on its own, as Simulator runs it
  std::string error;           // why it had to stop; empty where it did not
};

/// Why runs of this plan cannot go in lockstep; empty where they can.
std::string refuses_lanes(const Plan& plan, const SimulationSettings& settings);

/// Runs a plan once for each set of parameters: `lane_count` neighbours of the list at a time in lockstep,
/// with the error of the worst run and the events of all. Where that is not possible (`refuses_lanes`),
/// where the method auto leaves dp5 in the first run, or where one run fails, they run one by one. The same
/// list gives the same numbers with any number of threads and any instruction set. Throws
/// std::invalid_argument where a parameter cannot be set.
std::vector<LaneOutcome> run_in_lanes(const std::shared_ptr<const Plan>& plan,
                                      const SimulationSettings& settings, std::span<const ParameterSet> sets,
                                      const LaneOptions& options = {});

}  // namespace flyball
