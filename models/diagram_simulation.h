#pragma once

#include "models/diagram.h"
#include "models/diagram_parameters.h"
#include "models/diagram_report.h"

namespace flyball {

/// [simulation]. What is not given keeps its default.
SimulationSettings read_simulation(const TomlValue& section, ModelParameters& parameters, Report& report);

}  // namespace flyball
