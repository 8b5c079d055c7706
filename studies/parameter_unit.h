#pragma once

#include <string>
#include <string_view>

#include "models/plan.h"

namespace flyball {

/// The SI unit of "K" or "block.parameter", "1" for a plain number; empty where the model does not determine
/// it.
std::string parameter_unit(const Plan& plan, std::string_view name);

}  // namespace flyball
