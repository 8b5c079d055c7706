#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "solvers/lane_instant.h"
#include "solvers/log.h"
#include "solvers/simulator.h"

namespace flyball {

/// Runs groups of one plan, one after the other, in lockstep: step size and events are common to a group.
class LaneRun {
 public:
  virtual ~LaneRun() = default;

  /// Gives a lane an initialised run; lanes that are loaded without `counts` only fill the group.
  virtual void load(int lane, const Workspace<double>& initialised, bool counts) = 0;
  /// Runs the group to the stop time, or until `cancelled`, which is looked at now and then, is true; then
  /// the answer is false.
  virtual bool run(const std::function<bool()>& cancelled) = 0;
  /// Whether the run of a lane went through. If not, it must run on its own, which tells why.
  virtual bool finished(int lane) const = 0;
  /// At the end of the run of a lane: the stop time, or where a block ended it.
  virtual double value(int slot, int lane) const = 0;
  virtual Log take_log(int lane) = 0;
  /// The row that a log would end with: time, then the columns.
  virtual const std::vector<double>& end_row(int lane) = 0;

  static std::unique_ptr<LaneRun> make(Isa isa, const Plan& plan, const SimulationSettings& settings,
                                       const LogOptions& log);
};

}  // namespace flyball
