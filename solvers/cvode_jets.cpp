#include "solvers/cvode_jets.h"

#include <algorithm>
#include <exception>
#include <limits>
#include <utility>
#include <vector>

#include "blocks/jet.h"
#include "solvers/newton_matrix.h"
#include "solvers/reach.h"
#include "solvers/step_failure.h"
#include "solvers/sundials.h"

namespace flyball {
namespace {

using sundials::check;

constexpr int directions = Jet::DIMENSION - 1;  // the last one is time

class BdfOnJets final : public Stepper<Jet> {
 public:
  BdfOnJets(System<Jet>& system, const StepperOptions& options);

  void restart(Jet t, const Jet* x, StepMemory& memory, bool changed) override;
  Jet step(Jet limit, StepMemory& memory) override;
  const Jet* state() const override { return state_.data(); }
  void interpolate(Jet t, Jet* x) override;
  bool ends_with_rates() const override { return false; }

 private:
  /// A vector of numbers and one of each direction, and the Jets that they make.
  struct Parts {
    sundials::Vector value;
    std::vector<sundials::Vector> owned;
    std::vector<N_Vector> derivatives;  // as SUNDIALS wants them
  };
  Parts make_parts() const;
  void split(const Jet* x, Parts& parts) const;
  void join(const Parts& parts, Jet* x) const { join(parts.value.get(), parts.derivatives.data(), x); }
  void join(N_Vector value, const N_Vector* derivatives, Jet* x) const;

  static int rates(double t, N_Vector x, N_Vector dx, void* self);
  static int jacobian(double t, N_Vector x, N_Vector, SUNMatrix j, void* self, N_Vector, N_Vector, N_Vector);
  static int derivative_rates(int, double t, N_Vector x, N_Vector, N_Vector* s, N_Vector* ds, void* self,
                              N_Vector, N_Vector);
  static void ignore_message(int, const char*, const char*, char*, void*) {}
  template <class Evaluate>
  int guarded(Evaluate&& evaluate);

  Jet tiny_step(double limit, StepMemory& memory);
  [[noreturn]] void fail(int flag);

  System<Jet>& system_;
  StepperOptions options_;
  int size_;
  sundials::Context context_;
  Parts present_, scratch_;
  sundials::NewtonMatrix newton_;
  sundials::Cvode cvode_;  // uses the objects above, so it goes first
  std::vector<Jet> state_, x_, dx_;
  std::exception_ptr thrown_;
  double time_ = std::numeric_limits<double>::quiet_NaN();
  bool fresh_ = true;  // no step since the last restart
};

BdfOnJets::BdfOnJets(System<Jet>& system, const StepperOptions& options)
    : system_(system),
      options_(options),
      size_(system.size()),
      context_(sundials::make_context()),
      present_(make_parts()),
      scratch_(make_parts()),
      cvode_(sundials::own<sundials::Cvode>(CVodeCreate(CV_BDF, context_.get()))),
      state_(size_),
      x_(size_),
      dx_(size_) {
  void* cvode = cvode_.get();
  split(state_.data(), present_);
  check(CVodeSetErrHandlerFn(cvode, ignore_message, this), "CVodeSetErrHandlerFn", cvode);
  check(CVodeInit(cvode, rates, 0.0, present_.value.get()), "CVodeInit", cvode);
  check(CVodeSetUserData(cvode, this), "CVodeSetUserData", cvode);
  check(CVodeSStolerances(cvode, options.rtol, options.atol), "CVodeSStolerances", cvode);
  check(CVodeSetMaxStep(cvode, options.max_step), "CVodeSetMaxStep", cvode);
  check(CVodeSetMaxHnilWarns(cvode, -1), "CVodeSetMaxHnilWarns", cvode);
  newton_.attach(cvode, present_.value.get(), system.pattern(), jacobian);
  std::vector<double> atol(directions, options.atol);
  check(CVodeSensInit(cvode, directions, CV_STAGGERED, derivative_rates, present_.derivatives.data()),
        "CVodeSensInit", cvode);
  check(CVodeSensSStolerances(cvode, options.rtol, atol.data()), "CVodeSensSStolerances", cvode);
  check(CVodeSetSensErrCon(cvode, SUNTRUE), "CVodeSetSensErrCon", cvode);
}

BdfOnJets::Parts BdfOnJets::make_parts() const {
  const auto make = [&] { return sundials::own<sundials::Vector>(N_VNew_Serial(size_, context_.get())); };
  Parts parts;
  parts.value = make();
  for (int d = 0; d < directions; ++d) {
    parts.owned.push_back(make());
    parts.derivatives.push_back(parts.owned.back().get());
  }
  return parts;
}

void BdfOnJets::split(const Jet* x, Parts& parts) const {
  for (int i = 0; i < size_; ++i) {
    N_VGetArrayPointer(parts.value.get())[i] = x[i].a;
    for (int d = 0; d < directions; ++d) N_VGetArrayPointer(parts.derivatives[d])[i] = x[i].v[d];
  }
}

void BdfOnJets::join(N_Vector value, const N_Vector* derivatives, Jet* x) const {
  for (int i = 0; i < size_; ++i) {
    x[i] = Jet(N_VGetArrayPointer(value)[i]);
    for (int d = 0; d < directions; ++d) x[i].v[d] = N_VGetArrayPointer(derivatives[d])[i];
  }
}

/// No exception may cross SUNDIALS' C functions: it waits in thrown_ until `step` has control again.
template <class Evaluate>
int BdfOnJets::guarded(Evaluate&& evaluate) {
  try {
    evaluate();
    return 0;
  } catch (...) {
    thrown_ = std::current_exception();
    return -1;
  }
}

int BdfOnJets::rates(double t, N_Vector x, N_Vector dx, void* self) {
  auto& stepper = *static_cast<BdfOnJets*>(self);
  ++stepper.statistics_.rate_evaluations;
  return stepper.guarded([&] {
    for (int i = 0; i < stepper.size_; ++i) stepper.x_[i] = Jet(N_VGetArrayPointer(x)[i]);
    stepper.system_.rates(Jet(t), stepper.x_.data(), stepper.dx_.data());
    for (int i = 0; i < stepper.size_; ++i) N_VGetArrayPointer(dx)[i] = stepper.dx_[i].a;
  });
}

/// Rates of states that carry their derivatives have the derivatives f_x S + f_p.
int BdfOnJets::derivative_rates(int, double t, N_Vector x, N_Vector, N_Vector* s, N_Vector* ds, void* self,
                                N_Vector, N_Vector) {
  auto& stepper = *static_cast<BdfOnJets*>(self);
  ++stepper.statistics_.rate_evaluations;
  return stepper.guarded([&] {
    stepper.join(x, s, stepper.x_.data());
    stepper.system_.rates(Jet(t), stepper.x_.data(), stepper.dx_.data());
    for (int d = 0; d < directions; ++d) {
      for (int i = 0; i < stepper.size_; ++i) N_VGetArrayPointer(ds[d])[i] = stepper.dx_[i].v[d];
    }
  });
}

int BdfOnJets::jacobian(double t, N_Vector x, N_Vector, SUNMatrix j, void* self, N_Vector, N_Vector,
                        N_Vector) {
  auto& stepper = *static_cast<BdfOnJets*>(self);
  ++stepper.statistics_.jacobians;
  return stepper.guarded([&] {
    stepper.newton_.fill(j, stepper.system_.pattern(),
                         [&](double* values) { stepper.system_.jacobian(t, N_VGetArrayPointer(x), values); });
  });
}

void BdfOnJets::restart(Jet t, const Jet* x, StepMemory& memory, bool) {
  void* cvode = cvode_.get();
  std::copy(x, x + size_, state_.begin());
  split(x, present_);
  time_ = t.a;
  fresh_ = true;
  ++statistics_.restarts;
  check(CVodeReInit(cvode, time_, present_.value.get()), "CVodeReInit", cvode);
  check(CVodeSensReInit(cvode, CV_STAGGERED, present_.derivatives.data()), "CVodeSensReInit", cvode);
  check(CVodeSetInitStep(cvode, std::max(memory.size, 0.0)), "CVodeSetInitStep", cvode);
}

Jet BdfOnJets::step(Jet limit, StepMemory& memory) {
  if (fresh_ && limit.a - time_ < vanishing_step(limit.a, options_.max_step))
    return tiny_step(limit.a, memory);
  void* cvode = cvode_.get();
  check(CVodeSetStopTime(cvode, limit.a), "CVodeSetStopTime", cvode);
  const double horizon = std::min(limit.a, time_ + options_.max_step);  // scale for a first step
  const int flag = CVode(cvode, horizon, present_.value.get(), &time_, CV_ONE_STEP);
  if (flag < 0) fail(flag);
  double taken = 0.0;
  CVodeGetLastStep(cvode, &taken);
  if (std::exchange(fresh_, false)) memory.size = taken;
  check(CVodeGetSens(cvode, &time_, present_.derivatives.data()), "CVodeGetSens", cvode);
  join(present_, state_.data());
  ++statistics_.steps;
  return Jet(time_);
}

/// CVODE refuses to begin this close to a limit, where the state differs by rounding.
Jet BdfOnJets::tiny_step(double limit, StepMemory& memory) {
  system_.rates(Jet(time_), state_.data(), dx_.data());
  for (int i = 0; i < size_; ++i) x_[i] = state_[i] + (limit - time_) * dx_[i];
  restart(Jet(limit), x_.data(), memory, true);
  ++statistics_.steps;
  return Jet(limit);
}

void BdfOnJets::fail(int flag) {
  if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
  throw SimulationError(SimulationError::Kind::solver, time_,
                        sundials::describe(flag, "CVode", cvode_.get()));
}

void BdfOnJets::interpolate(Jet t, Jet* x) {
  if (fresh_) {
    std::copy(state_.begin(), state_.end(), x);
    return;
  }
  void* cvode = cvode_.get();
  check(CVodeGetDky(cvode, t.a, 0, scratch_.value.get()), "CVodeGetDky", cvode);
  check(CVodeGetSensDky(cvode, t.a, 0, scratch_.derivatives.data()), "CVodeGetSensDky", cvode);
  join(scratch_, x);
}

}  // namespace

std::unique_ptr<Stepper<Jet>> make_bdf_on_jets(System<Jet>& system, const StepperOptions& options) {
  return std::make_unique<BdfOnJets>(system, options);
}

}  // namespace flyball
