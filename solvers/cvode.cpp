#include "solvers/cvode.h"

#include <algorithm>
#include <exception>
#include <limits>
#include <stdexcept>
#include <utility>

#include "solvers/newton_matrix.h"
#include "solvers/reach.h"
#include "solvers/step_failure.h"
#include "solvers/sundials.h"

namespace flyball {
namespace {

using sundials::check;

class CvodeStepper final : public Stepper<double> {
 public:
  CvodeStepper(int method, System<double>& system, const StepperOptions& options);

  void restart(double t, const double* x, StepMemory& memory, bool changed) override;
  double step(double limit, StepMemory& memory) override;
  const double* state() const override { return N_VGetArrayPointer(state_.get()); }
  void interpolate(double t, double* x) override;
  bool ends_with_rates() const override { return false; }
  int limiting_state() const override;

 private:
  void use_fixed_point();

  static int rates(double t, N_Vector x, N_Vector dx, void* self);
  static int jacobian(double t, N_Vector x, N_Vector, SUNMatrix j, void* self, N_Vector, N_Vector, N_Vector);
  static void keep_message(int code, const char*, const char*, char* message, void* self);
  template <class Evaluate>
  int guarded(Evaluate&& evaluate);

  void begin_history(double t, double first_step);
  double idle_step(double limit);
  double tiny_step(double limit, const StepMemory& memory);
  double multistep(double limit, StepMemory& memory);
  void count_steps();
  void remember(double limit, StepMemory& memory) const;
  [[noreturn]] void fail(int flag);
  std::vector<double> weighted_errors() const;
  std::vector<WeightedError> worst() const { return worst_states(system_, weighted_errors()); }

  System<double>& system_;
  StepperOptions options_;
  int size_;
  sundials::Context context_;
  sundials::Vector state_;  // at reached_
  sundials::Vector scratch_;
  sundials::Vector borrowed_;  // a caller's array during a call
  sundials::NewtonMatrix newton_;
  sundials::NonlinearSolver fixed_point_;
  sundials::Cvode cvode_;  // uses the objects above, so it goes first
  std::exception_ptr thrown_;
  std::string message_;  // SUNDIALS' own words about its last failure

  // CVODE's last step is [began_, reached_]; the caller stands at position_, which is inside it after a
  // restart that changed nothing.
  double began_, reached_, position_;
  bool fresh_ = true;  // no step since the history began
  long history_steps_ = 0, history_rejected_ = 0;
};

CvodeStepper::CvodeStepper(int method, System<double>& system, const StepperOptions& options)
    : system_(system),
      options_(options),
      size_(system.size()),
      context_(sundials::make_context()),
      state_(sundials::own<sundials::Vector>(N_VNew_Serial(size_, context_.get()))),
      scratch_(sundials::own<sundials::Vector>(N_VNew_Serial(size_, context_.get()))),
      borrowed_(sundials::own<sundials::Vector>(N_VNewEmpty_Serial(size_, context_.get()))),
      cvode_(sundials::own<sundials::Cvode>(CVodeCreate(method, context_.get()))),
      began_(std::numeric_limits<double>::quiet_NaN()),
      reached_(began_),
      position_(began_) {
  if (!(options.max_step > 0.0)) throw std::invalid_argument("CVODE needs a max_step above 0");
  void* cvode = cvode_.get();
  N_VConst(0.0, state_.get());
  check(CVodeSetErrHandlerFn(cvode, keep_message, this), "CVodeSetErrHandlerFn", cvode);
  check(CVodeInit(cvode, rates, 0.0, state_.get()), "CVodeInit", cvode);
  check(CVodeSetUserData(cvode, this), "CVodeSetUserData", cvode);
  check(CVodeSStolerances(cvode, options.rtol, options.atol), "CVodeSStolerances", cvode);
  check(CVodeSetMaxStep(cvode, options.max_step), "CVodeSetMaxStep", cvode);
  // After an instant the remembered size may be far too long, as when rest ends: the 7 and 10 cuts of
  // CVODE would not do.
  check(CVodeSetMaxErrTestFails(cvode, 40), "CVodeSetMaxErrTestFails", cvode);
  check(CVodeSetMaxConvFails(cvode, 40), "CVodeSetMaxConvFails", cvode);
  // Steps lost in rounding are an error here, so no warnings are wanted.
  check(CVodeSetMaxHnilWarns(cvode, -1), "CVodeSetMaxHnilWarns", cvode);
  if (size_ == 0) return;
  if (method == CV_ADAMS) {
    use_fixed_point();
  } else {
    newton_.attach(cvode, state_.get(), system.pattern(), jacobian);
  }
}

void CvodeStepper::use_fixed_point() {
  fixed_point_ =
      sundials::own<sundials::NonlinearSolver>(SUNNonlinSol_FixedPoint(state_.get(), 0, context_.get()));
  check(CVodeSetNonlinearSolver(cvode_.get(), fixed_point_.get()), "CVodeSetNonlinearSolver", cvode_.get());
}

/// No exception may cross SUNDIALS' C functions: it waits in thrown_ until `step` has control again.
template <class Evaluate>
int CvodeStepper::guarded(Evaluate&& evaluate) {
  if (thrown_) return -1;  // fixed-point iteration tries a shorter step even after an unrecoverable failure
  try {
    evaluate();
    return 0;
  } catch (...) {
    thrown_ = std::current_exception();
    return -1;
  }
}

int CvodeStepper::rates(double t, N_Vector x, N_Vector dx, void* self) {
  auto& stepper = *static_cast<CvodeStepper*>(self);
  ++stepper.statistics_.rate_evaluations;
  return stepper.guarded([&] { stepper.system_.rates(t, N_VGetArrayPointer(x), N_VGetArrayPointer(dx)); });
}

int CvodeStepper::jacobian(double t, N_Vector x, N_Vector, SUNMatrix j, void* self, N_Vector, N_Vector,
                           N_Vector) {
  auto& stepper = *static_cast<CvodeStepper*>(self);
  ++stepper.statistics_.jacobians;
  return stepper.guarded([&] {
    stepper.newton_.fill(j, stepper.system_.pattern(),
                         [&](double* values) { stepper.system_.jacobian(t, N_VGetArrayPointer(x), values); });
  });
}

void CvodeStepper::keep_message(int, const char*, const char*, char* message, void* self) {
  static_cast<CvodeStepper*>(self)->message_ = message;
}

void CvodeStepper::restart(double t, const double* x, StepMemory& memory, bool changed) {
  if (!changed && began_ <= t && t <= reached_) {
    position_ = t;
    return;
  }
  std::copy(x, x + size_, N_VGetArrayPointer(state_.get()));
  ++statistics_.restarts;
  begin_history(t, memory.size);
}

void CvodeStepper::begin_history(double t, double first_step) {
  began_ = reached_ = position_ = t;
  fresh_ = true;
  history_steps_ = history_rejected_ = 0;
  check(CVodeReInit(cvode_.get(), t, state_.get()), "CVodeReInit", cvode_.get());
  check(CVodeSetInitStep(cvode_.get(), std::max(first_step, 0.0)), "CVodeSetInitStep", cvode_.get());
}

double CvodeStepper::step(double limit, StepMemory& memory) {
  if (limit < position_) throw std::logic_error("a step to a limit in the past");
  if (size_ == 0) return idle_step(limit);
  if (position_ < reached_) {
    if (reached_ <= limit) return position_ = reached_;
    interpolate(position_, N_VGetArrayPointer(scratch_.get()));
    N_VScale(1.0, scratch_.get(), state_.get());
    begin_history(position_, memory.size);
  }
  if (fresh_ && limit - position_ < vanishing_step(limit, options_.max_step)) return tiny_step(limit, memory);
  return multistep(limit, memory);
}

double CvodeStepper::idle_step(double limit) {
  const Reach next = reach(options_.max_step, limit - position_, options_.max_step);
  began_ = position_;
  position_ = reached_ = next.lands ? limit : position_ + next.size;
  ++statistics_.steps;
  return position_;
}

/// CVODE refuses to begin this close to a limit, where the state differs by rounding.
double CvodeStepper::tiny_step(double limit, const StepMemory& memory) {
  ++statistics_.rate_evaluations;
  system_.rates(position_, N_VGetArrayPointer(state_.get()), N_VGetArrayPointer(scratch_.get()));
  N_VLinearSum(1.0, state_.get(), limit - position_, scratch_.get(), state_.get());
  ++statistics_.steps;
  begin_history(limit, memory.size);
  return limit;
}

double CvodeStepper::multistep(double limit, StepMemory& memory) {
  void* cvode = cvode_.get();
  check(CVodeSetStopTime(cvode, limit), "CVodeSetStopTime", cvode);
  double time = position_;
  const double horizon =
      std::min(limit, position_ + options_.max_step);  // scale for a first step of CVODE's choice
  const int flag = CVode(cvode, horizon, state_.get(), &time, CV_ONE_STEP);
  if (flag < 0) fail(flag);
  began_ = position_;
  position_ = reached_ = time;
  count_steps();
  if (std::exchange(fresh_, false)) remember(limit, memory);
  double taken = 0.0;
  CVodeGetLastStep(cvode, &taken);
  if (flag != CV_TSTOP_RETURN && taken < vanishing_step(time, options_.max_step))
    throw step_vanished(time, taken, worst());
  return time;
}

void CvodeStepper::count_steps() {
  long steps = 0, error_tests = 0, iterations = 0;
  CVodeGetNumSteps(cvode_.get(), &steps);
  CVodeGetNumErrTestFails(cvode_.get(), &error_tests);
  CVodeGetNumStepSolveFails(cvode_.get(), &iterations);
  statistics_.steps += steps - std::exchange(history_steps_, steps);
  const long rejected = error_tests + iterations;
  statistics_.rejected += rejected - std::exchange(history_rejected_, rejected);
}

/// Only what follows a first step is worth remembering: the next restart begins at order 1 again.
void CvodeStepper::remember(double limit, StepMemory& memory) const {
  double next = 0.0;
  CVodeGetCurrentStep(cvode_.get(), &next);
  const bool shortened = next >= (limit - reached_) * (1.0 - 1e-9);
  memory.size = shortened ? std::max(memory.size, next) : next;
}

void CvodeStepper::fail(int flag) {
  began_ = std::numeric_limits<double>::quiet_NaN();  // no history to go on with
  if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
  const std::string what = sundials::describe(flag, "CVode", cvode_.get());
  double time = position_;
  CVodeGetCurrentTime(cvode_.get(), &time);
  if (flag == CV_ERR_FAILURE || flag == CV_CONV_FAILURE || flag == CV_TOO_MUCH_ACC) {
    throw SimulationError(SimulationError::Kind::step_vanished, time,
                          "the step vanished: " + what + " (" + to_string(worst()) + ")");
  }
  throw SimulationError(SimulationError::Kind::solver, time, what + ": " + message_);
}

int CvodeStepper::limiting_state() const { return size_ > 0 ? worst_places(weighted_errors()).front() : -1; }

std::vector<double> CvodeStepper::weighted_errors() const {
  CVodeGetEstLocalErrors(cvode_.get(), scratch_.get());
  std::vector<double> weighted(N_VGetArrayPointer(scratch_.get()),
                               N_VGetArrayPointer(scratch_.get()) + size_);
  CVodeGetErrWeights(cvode_.get(), scratch_.get());
  for (int i = 0; i < size_; ++i) weighted[i] *= N_VGetArrayPointer(scratch_.get())[i];
  return weighted;
}

void CvodeStepper::interpolate(double t, double* x) {
  if (fresh_) {
    std::copy(state(), state() + size_, x);
    return;
  }
  N_VSetArrayPointer(x, borrowed_.get());
  check(CVodeGetDky(cvode_.get(), t, 0, borrowed_.get()), "CVodeGetDky", cvode_.get());
}

}  // namespace

std::unique_ptr<Stepper<double>> make_adams(System<double>& system, const StepperOptions& options) {
  return std::make_unique<CvodeStepper>(CV_ADAMS, system, options);
}

std::unique_ptr<Stepper<double>> make_bdf(System<double>& system, const StepperOptions& options) {
  return std::make_unique<CvodeStepper>(CV_BDF, system, options);
}

}  // namespace flyball
