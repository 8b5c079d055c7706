#pragma once

#include <string>

#include "solvers/plan_system.h"

namespace flyball {

/// How a run was integrated, and why.
struct MethodReport {
  std::string method;  // never auto
  std::string reason;  // of auto's choice; empty when the method was asked for
};

/// The method of `make_stepper` for a run: what was asked for, or what fits the diagram best from the start.
std::string first_method(const Plan& plan, const PlanSystem& system, const SimulationSettings& settings);

/// What `method`, the answer of first_method, has come to.
MethodReport report_method(const std::string& method, const Plan& plan, const SimulationSettings& settings,
                           const StepMemory& memory);

}  // namespace flyball
