#pragma once

#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunmatrix/sunmatrix_sparse.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <memory>
#include <string>
#include <type_traits>

// SUNDIALS behind handles that free themselves. Besides sources of this folder only the benchmark that drives
// CVODE without Flyball includes it.
namespace flyball::sundials {

static_assert(std::is_same_v<sunrealtype, double>, "SUNDIALS must be built for double");

/// Calls the right one of SUNDIALS' free functions.
struct Release {
  void operator()(SUNContext context) const { SUNContext_Free(&context); }
  void operator()(N_Vector vector) const { N_VDestroy(vector); }
  void operator()(SUNMatrix matrix) const { SUNMatDestroy(matrix); }
  void operator()(SUNLinearSolver solver) const { SUNLinSolFree(solver); }
  void operator()(SUNNonlinearSolver solver) const { SUNNonlinSolFree(solver); }
};

struct ReleaseCvode {
  void operator()(void* cvode) const { CVodeFree(&cvode); }
};

template <class Pointer>
using Handle = std::unique_ptr<std::remove_pointer_t<Pointer>, Release>;

using Context = Handle<SUNContext>;
using Vector = Handle<N_Vector>;
using Matrix = Handle<SUNMatrix>;
using LinearSolver = Handle<SUNLinearSolver>;
using NonlinearSolver = Handle<SUNNonlinearSolver>;
using Cvode = std::unique_ptr<void, ReleaseCvode>;

/// One a stepper: contexts are not shared between threads.
Context make_context();

/// "CVode failed with CV_ERR_FAILURE at t = 0.4 s, after a step of 1e-05 s of order 3".
std::string describe(int flag, const char* call, void* cvode);

/// Throws SimulationError (solver) with that description when `flag` is below 0.
void check(int flag, const char* call, void* cvode);

/// The handle of a new object. SUNDIALS reports the failure to make one as null: std::bad_alloc.
template <class Owner>
Owner own(typename Owner::pointer object) {
  if (!object) throw std::bad_alloc();
  return Owner(object);
}

}  // namespace flyball::sundials
