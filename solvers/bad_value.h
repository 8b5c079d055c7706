#pragma once

#include <string>
#include <vector>

#include "models/plan.h"

namespace flyball {

/// Calls instance `k` of a batch and throws SimulationError (not_finite), with block, port, time and inputs,
/// when it made something bad: outputs and rates must be finite, relations, crossings and alarms not NaN.
void check_call(const Op& op, int k, const Plan& plan, const Frame<double>& frame);

/// Throws SimulationError (not_finite): "limit.y is nan at t = 2 s (u = 1)". The readings are those of
/// `instance`; -1: none.
[[noreturn]] void throw_bad_value(const std::string& what, double value, int instance, const Plan& plan,
                                  const double* values);

}  // namespace flyball
