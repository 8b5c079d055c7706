#pragma once

#include <vector>

#include "models/diagram_parameters.h"
#include "models/diagram_ports.h"

namespace flyball {

/// `guesses` of [diagram]: where the solution of an algebraic loop is looked for at the start.
std::vector<Guess> read_guesses(const TomlValue& guesses, const ModelBlocks& blocks,
                                ModelParameters& parameters, Report& report);

}  // namespace flyball
