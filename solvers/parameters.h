#pragma once

#include <string_view>

#include "solvers/workspace.h"

namespace flyball {

/// The slot of "K" or "block.parameter". Throws std::invalid_argument when there is none, or when nothing may
/// set it.
int settable_parameter(const Plan& plan, std::string_view name);

/// Throws std::invalid_argument when the parameter in a slot is structural or computed from others.
void require_settable(const Plan& plan, int slot);

/// Throws std::invalid_argument when a parameter is outside of its range.
void require_in_range(const Plan& plan, const Workspace<double>& workspace);

}  // namespace flyball
