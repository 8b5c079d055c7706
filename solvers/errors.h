#pragma once

#include <limits>
#include <stdexcept>
#include <string>

namespace flyball {

/// A run that had to stop: what happened, where and when. What was logged before stays with the simulator.
class SimulationError : public std::runtime_error {
 public:
  enum class Kind { not_finite, step_vanished, chattering, alarm, algebraic_loop, asserted, solver };

  SimulationError(Kind kind, double time, const std::string& message)
      : std::runtime_error(message), kind_(kind), time_(time) {}

  Kind kind() const { return kind_; }
  double time() const { return time_; }

 private:
  Kind kind_;
  double time_;
};

/// A number as messages show it: the sign of NaN means nothing.
inline double shown(double x) { return x == x ? x : std::numeric_limits<double>::quiet_NaN(); }

}  // namespace flyball
