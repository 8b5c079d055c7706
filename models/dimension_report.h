#pragma once

#include <vector>

#include "models/dimension_conflict.h"

namespace flyball {

/// Reports a contradiction: what is wrong, the equations in the order in which one follows from the other,
/// and the other ways to settle it.
void report_conflict(const SignalEquations& equations, const Conflict& conflict, Diagnostics& diagnostics);

/// "K2 = K_H*H", "gamma/s = turn", "sine wants a plain number as gamma".
std::string equation_text(const SignalEquations& equations, const SignalEquation& equation);

}  // namespace flyball
