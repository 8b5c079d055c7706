#include <algorithm>

#include "benchmarks/chain.h"
#include "solvers/sundials.h"

namespace flyball::bench {
namespace {

using sundials::check;

int rates(double, N_Vector x, N_Vector dx, void* chain) {
  static_cast<const Chain*>(chain)->rates(N_VGetArrayPointer(x), N_VGetArrayPointer(dx));
  return 0;
}

/// Column c: the rates of c - 1, c and c + 1 by the state c.
int jacobian(double, N_Vector, N_Vector, SUNMatrix j, void* user, N_Vector, N_Vector, N_Vector) {
  const Chain& chain = *static_cast<const Chain*>(user);
  const int n = chain.size();
  sunindextype* start = SM_INDEXPTRS_S(j);
  sunindextype* row = SM_INDEXVALS_S(j);
  double* value = SM_DATA_S(j);
  sunindextype at = 0;
  for (int c = 0; c < n; ++c) {
    start[c] = at;
    for (int r = std::max(c - 1, 0); r <= std::min(c + 1, n - 1); ++r) {
      row[at] = r;
      value[at++] = r == c ? -2.0 * chain.k[r] : chain.k[r];
    }
  }
  start[n] = at;
  return 0;
}

}  // namespace

std::vector<double> solve_chain_bdf(const Chain& chain, double rtol, double atol) {
  const sundials::Context context = sundials::make_context();
  const int n = chain.size();
  const auto x = sundials::own<sundials::Vector>(N_VNew_Serial(n, context.get()));
  N_VConst(0.0, x.get());
  const auto matrix =
      sundials::own<sundials::Matrix>(SUNSparseMatrix(n, n, 3 * n - 2, CSC_MAT, context.get()));
  const auto linear =
      sundials::own<sundials::LinearSolver>(SUNLinSol_KLU(x.get(), matrix.get(), context.get()));
  const auto owner = sundials::own<sundials::Cvode>(CVodeCreate(CV_BDF, context.get()));
  void* cvode = owner.get();
  check(CVodeInit(cvode, rates, 0.0, x.get()), "CVodeInit", cvode);
  check(CVodeSetUserData(cvode, const_cast<Chain*>(&chain)), "CVodeSetUserData", cvode);
  check(CVodeSStolerances(cvode, rtol, atol), "CVodeSStolerances", cvode);
  check(CVodeSetMaxNumSteps(cvode, -1), "CVodeSetMaxNumSteps", cvode);
  check(CVodeSetStopTime(cvode, Chain::stop), "CVodeSetStopTime", cvode);
  check(CVodeSetLinearSolver(cvode, linear.get(), matrix.get()), "CVodeSetLinearSolver", cvode);
  check(CVodeSetJacFn(cvode, jacobian), "CVodeSetJacFn", cvode);
  double t = 0.0;
  check(CVode(cvode, Chain::stop, x.get(), &t, CV_NORMAL), "CVode", cvode);
  const double* values = N_VGetArrayPointer(x.get());
  return {values, values + n};
}

}  // namespace flyball::bench
