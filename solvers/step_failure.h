#pragma once

#include <string>
#include <vector>

#include "solvers/errors.h"
#include "solvers/stepper.h"

namespace flyball {

/// One state of a failed step, with its error as a multiple of its tolerance.
struct WeightedError {
  std::string state;
  double multiple = 0.0;
};

/// At most three places of `weighted`, the largest first; what is not a number counts as infinite.
std::vector<int> worst_places(const std::vector<double>& weighted);

/// "plant.x: error 3.1e+02 times the tolerance; plant.v: …"
std::string to_string(const std::vector<WeightedError>& errors);

/// The states of `system` with the largest weighted errors, one entry of `weighted` a state.
template <class T>
std::vector<WeightedError> worst_states(const System<T>& system, const std::vector<double>& weighted) {
  std::vector<WeightedError> worst;
  for (const int i : worst_places(weighted)) worst.push_back({system.state_name(i), weighted[i]});
  return worst;
}

/// The error of a step [s] that is lost in the rounding of the time [s] at which it begins.
SimulationError step_vanished(double time, double step, const std::vector<WeightedError>& worst);

}  // namespace flyball
