#pragma once

#include "models/order.h"
#include "models/plan.h"

namespace flyball {

// The stages of planning. Each fills its part of the plan from those before it.

/// Places instances, gives every number its slot, and writes the index maps, bindings and initial values.
void lay_out(Plan& plan, const Order& order);

/// Finds the base tick and the hits of each rate.
void plan_hits(Plan& plan, Diagnostics& diagnostics);

/// Writes all programs.
void write_programs(Plan& plan, const Order& order);

/// The pattern of the Jacobian, and its colouring.
void find_pattern(Plan& plan);

}  // namespace flyball
