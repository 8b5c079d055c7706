#pragma once

#include <string_view>

#include "solvers/workspace.h"

namespace flyball {

/// The slot of a parameter that a run may set: "K" or "block.parameter". Throws std::invalid_argument when
/// there is none, and when it is structural or derived.
int settable_slot(const Plan& plan, std::string_view name);

/// Throws std::invalid_argument that names the first parameter out of its range.
void require_in_range(const Plan& plan, const Workspace<double>& workspace);

}  // namespace flyball
