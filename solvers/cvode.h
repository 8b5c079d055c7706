#pragma once

#include <memory>

#include "solvers/stepper.h"

namespace flyball {

/// CVODE in one-step mode: Adams formulas of order 1 to 12 with fixed-point iteration, for smooth diagrams
/// that are not stiff.
///
/// Steps end on a limit exactly. Inside a step the state is the interpolating polynomial of the method
/// itself. After a restart with changes the order is 1 again; what StepMemory.size then hands over is the
/// size that the method proposed after its last first step, not that of a high order. An exception of the
/// system passes through `step`; then the next call must be `restart`.
///
/// Source: Hindmarsh et al., SUNDIALS, ACM Trans. Math. Softw. 31 (2005) 363-396.
std::unique_ptr<Stepper<double>> make_adams(System<double>& system, const StepperOptions& options);

/// The same with BDF of order 1 to 5 and Newton's method on the system's Jacobian, for stiff diagrams: dense
/// LU for few states, KLU for many.
std::unique_ptr<Stepper<double>> make_bdf(System<double>& system, const StepperOptions& options);

}  // namespace flyball
