#pragma once

#include <vector>

#include "models/diagram_expressions.h"
#include "models/diagram_ports.h"

namespace flyball {

/// `guesses` of [diagram] of the model itself: where the solution of an algebraic loop is looked for at the
/// start.
std::vector<Guess> read_guesses(const TomlValue& guesses, const ModelBlocks& blocks,
                                const Expressions& expressions);

}  // namespace flyball
