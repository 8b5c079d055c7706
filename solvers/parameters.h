#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "solvers/workspace.h"

namespace flyball {

/// Values of parameters by slot (Plan::parameter_slot), SI.
using ParameterSet = std::vector<std::pair<int, double>>;

/// The slot of "K" or "block.parameter". Throws std::invalid_argument when there is none, or when nothing may
/// set it.
int settable_parameter(const Plan& plan, std::string_view name);

/// Throws std::invalid_argument when the parameter in a slot is structural or computed from others.
void require_settable(const Plan& plan, int slot);

/// Sets parameters and recomputes what is derived from them. Throws std::invalid_argument when one is then
/// outside of its range.
void set_parameters(const Plan& plan, const ParameterSet& set, Workspace<double>& workspace);

/// Throws std::invalid_argument when a parameter is outside of its range.
void require_in_range(const Plan& plan, const Workspace<double>& workspace);

}  // namespace flyball
