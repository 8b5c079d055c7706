#pragma once

#include <memory>

#include "solvers/stepper.h"

namespace flyball {

/// CVODES' BDF with forward sensitivities, S' = f_x S + f_p, as a stepper on Jets: for stiff diagrams. The
/// first three directions of the Jets are parameters, whose errors limit the steps. Each is corrected after
/// the state, with the state's Newton matrix. Every restart begins at order 1, and time carries no
/// derivative.
///
/// Source: Serban, Hindmarsh, CVODES, Proc. ASME IDETC 2005, section 2 (staggered corrector).
std::unique_ptr<Stepper<Jet>> make_bdf_on_jets(System<Jet>& system, const StepperOptions& options);

}  // namespace flyball
