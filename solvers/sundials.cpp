#include "solvers/sundials.h"

#include <fmt/format.h>

#include <cstdlib>

#include "solvers/errors.h"

namespace flyball::sundials {

Context make_context() {
  SUNContext context = nullptr;
  if (SUNContext_Create(nullptr, &context) != 0) throw std::bad_alloc();
  return Context(context);
}

namespace {

double current_time(void* cvode) {
  double time = 0.0;
  CVodeGetCurrentTime(cvode, &time);
  return time;
}

}  // namespace

std::string describe(int flag, const char* call, void* cvode) {
  const std::unique_ptr<char, decltype(&std::free)> name(CVodeGetReturnFlagName(flag), &std::free);
  double step = 0.0;
  int order = 0;
  CVodeGetLastStep(cvode, &step);
  CVodeGetLastOrder(cvode, &order);
  return fmt::format("{} failed with {} at t = {:.10g} s, after a step of {:.2g} s of order {}", call,
                     name.get(), current_time(cvode), step, order);
}

void check(int flag, const char* call, void* cvode) {
  if (flag >= 0) return;
  throw SimulationError(SimulationError::Kind::solver, current_time(cvode), describe(flag, call, cvode));
}

}  // namespace flyball::sundials
