#include "solvers/kinsol.h"

#include <kinsol/kinsol.h>

#include <algorithm>
#include <new>

#include "solvers/sundials.h"

namespace flyball {
namespace {

struct ReleaseKinsol {
  void operator()(void* kinsol) const { KINFree(&kinsol); }
};

int residual(N_Vector z, N_Vector f, void* equations) {
  const auto& of = *static_cast<const Equations*>(equations);
  return of.residual(NV_DATA_S(z), NV_DATA_S(f)) ? 0 : 1;
}

int jacobian(N_Vector z, N_Vector, SUNMatrix columns, void* equations, N_Vector, N_Vector) {
  const auto& of = *static_cast<const Equations*>(equations);
  return of.jacobian(NV_DATA_S(z), SM_DATA_D(columns)) ? 0 : 1;
}

/// What KINSOL would print: whoever asked tells the user what it means.
void ignore(int, const char*, const char*, char*, void*) {}

void require(int flag) {
  if (flag != KIN_SUCCESS) throw std::bad_alloc();
}

constexpr int most_iterations = 200;

}  // namespace

struct Kinsol::Memory {
  explicit Memory(int n)
      : size(n),
        context(sundials::make_context()),
        z(sundials::own<sundials::Vector>(N_VNew_Serial(n, context.get()))),
        scale(sundials::own<sundials::Vector>(N_VNew_Serial(n, context.get()))),
        matrix(sundials::own<sundials::Matrix>(SUNDenseMatrix(n, n, context.get()))),
        linear(sundials::own<sundials::LinearSolver>(SUNLinSol_Dense(z.get(), matrix.get(), context.get()))),
        kinsol(KINCreate(context.get())) {
    if (kinsol == nullptr) throw std::bad_alloc();
    N_VConst(1.0, scale.get());
    require(KINSetErrHandlerFn(kinsol.get(), ignore, nullptr));
    require(KINInit(kinsol.get(), residual, z.get()));
    require(KINSetLinearSolver(kinsol.get(), linear.get(), matrix.get()));
    require(KINSetJacFn(kinsol.get(), jacobian));
    require(KINSetMaxSetupCalls(kinsol.get(), 1));  // a new Jacobian at each iteration
    require(KINSetNumMaxIters(kinsol.get(), most_iterations));
  }

  int size;
  sundials::Context context;
  sundials::Vector z, scale;
  sundials::Matrix matrix;
  sundials::LinearSolver linear;
  std::unique_ptr<void, ReleaseKinsol> kinsol;
};

Kinsol::Kinsol() = default;
Kinsol::~Kinsol() = default;
Kinsol::Kinsol(const Kinsol&) {}
Kinsol& Kinsol::operator=(const Kinsol& other) {
  if (this != &other) memory_.reset();
  return *this;
}

bool Kinsol::solve(int n, const Equations& equations, double tolerance, double* z) {
  if (memory_ == nullptr || memory_->size != n) memory_ = std::make_unique<Memory>(n);
  void* kinsol = memory_->kinsol.get();
  require(KINSetUserData(kinsol, const_cast<Equations*>(&equations)));
  require(KINSetFuncNormTol(kinsol, tolerance));
  double* at = NV_DATA_S(memory_->z.get());
  std::copy_n(z, n, at);
  const int flag =
      KINSol(kinsol, memory_->z.get(), KIN_LINESEARCH, memory_->scale.get(), memory_->scale.get());
  if (flag < 0) return false;
  std::copy_n(at, n, z);
  return true;
}

}  // namespace flyball
