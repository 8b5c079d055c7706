#pragma once

#include "models/diagram.h"
#include "models/diagram_expressions.h"

namespace flyball {

/// [simulation] of a diagram with these continuous states ("plant.x"). What is not given keeps its default.
SimulationSettings read_simulation(const TomlValue& section, const std::vector<std::string>& states,
                                   const Expressions& expressions);

}  // namespace flyball
