#pragma once

#include <string>
#include <vector>

#include "solvers/errors.h"
#include "solvers/zeros.h"

namespace flyball {

/// Which numbers the rates depend on at an instant, by slot: outputs, states, held values and bits. Outputs
/// of sampled blocks are latched, so what is behind them does not count, nor does what a bit's relation
/// reads.
std::vector<bool> behind_rates(const Plan& plan);

/// The error of `events` located events in a row without progress, by what fired in them, as Zeros counts.
/// First come those on which a rate depends: they are what makes the motion slide.
SimulationError chattering(double t, int events, std::vector<int> fired, const Plan& plan,
                           const Zeros& zeros);

}  // namespace flyball
