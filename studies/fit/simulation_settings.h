#pragma once

#include <string_view>

#include "models/diagram.h"

namespace flyball {

/// Gives a number to "simulation.KEY": stop, rtol, atol, step, max_step. False when the name is not of this
/// form; throws std::invalid_argument when there is no such key, or the number is not above 0.
bool set_simulation(SimulationSettings& settings, std::string_view name, double value);

}  // namespace flyball
