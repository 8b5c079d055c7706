#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "blocks/scalar.h"
#include "models/sparsity.h"
#include "solvers/extension.h"
#include "solvers/stiffness.h"

namespace flyball {

/// Rates x' = matrix x + inputs w + offset, where the inputs w stand still until the next instant.
struct LinearRates {
  std::vector<double> matrix, inputs;  // by rows
  std::vector<double> offset;
  /// As long as no state and no input is larger, all that is computed on the way to the rates is finite.
  double largest = std::numeric_limits<double>::max();
  long version = 0;  // counts changes; 0: never set
};

/// The right-hand side of x' = f(t, x) between two instants, as a stepper sees it.
template <class T>
class System {
 public:
  virtual ~System() = default;
  virtual int size() const = 0;
  /// Throws SimulationError (not_finite) that names the block when anything on the way is not finite.
  virtual void rates(T t, const T* x, T* dx) = 0;
  /// For messages: "plant.x".
  virtual std::string state_name(int i) const = 0;

  /// The exact Jacobian df/dx. Its pattern contains the diagonal.
  virtual const Sparsity& pattern() const = 0;
  /// `values[k]` belongs to pattern().row[k].
  virtual void jacobian(double t, const double* x, double* values) = 0;

  /// What the rates are until the next instant, where they are linear and do not depend on time by itself;
  /// else nullptr.
  virtual const LinearRates* linear_rates() { return nullptr; }
  /// Gives the inputs of `linear_rates`.
  virtual void held_inputs(double* /*w*/) const {}
};

struct StepperOptions {
  double rtol = 1e-6;
  double atol = 1e-8;
  double max_step = 0.0;           // above 0
  double fixed_step = 0.0;         // of fixed-step methods, above 0
  bool derivative_errors = false;  // on Jets: whether the errors of derivatives limit a step, too
};

/// What a variable-step method carries from step to step. It belongs to the workspace, so that a copied
/// workspace continues with the same bits.
struct StepMemory {
  double size = 0.0;         // the step to try next; 0: the method chooses
  double last_error = 1e-4;  // weighted error of the last accepted step (PI controller)

  // What `auto` knows of stiffness.
  StiffnessCount stiffness = {};
  double stiff_since = std::numeric_limits<double>::infinity();  // s; BDF from then on
  int stiffest_state = -1;
};

struct StepperStatistics {
  long steps = 0;
  long rejected = 0;
  long rate_evaluations = 0;
  long jacobians = 0;
  long restarts = 0;
};

/// Advances a system by one accepted step at a time. All methods share this interface, so that instants,
/// location of events and logging are written once.
template <class T>
class Stepper {
 public:
  virtual ~Stepper() = default;

  /// Begins at (t, x), after an instant. `changed` is false when nothing that a rate depends on has changed:
  /// a multistep method then keeps its history. The step size in `memory` is kept either way.
  virtual void restart(T t, const T* x, StepMemory& memory, bool changed) = 0;

  /// One accepted step, never beyond `limit` and ending on it exactly when it is near. Returns the new time.
  /// Throws SimulationError when the step vanishes, naming the states with the largest weighted error.
  virtual T step(T limit, StepMemory& memory) = 0;

  /// The state at the end of the last step.
  virtual const T* state() const = 0;
  /// The state inside the last step, from its continuous extension (which a method may prepare when first
  /// asked).
  virtual void interpolate(T t, T* x) = 0;

  /// Whether the last call of System::rates in `step` was at the end point: its outputs can then be used.
  virtual bool ends_with_rates() const = 0;

  /// What `interpolate` evaluates, until the next step, where it is a polynomial of at most fourth degree in
  /// time; else nothing.
  virtual std::optional<Extension<T>> extension() { return std::nullopt; }

  /// The state with the largest weighted error in the last step; -1 when the method estimates none.
  virtual int limiting_state() const { return -1; }

  virtual StepperStatistics statistics() const { return statistics_; }

 protected:
  StepperStatistics statistics_;
};

/// A stepper by the name of its method: auto (dp5, and bdf once the system is stiff), dp5, rk4, heun, euler,
/// exact (of affine systems), discrete (without states), adams, bdf (CVODE).
std::unique_ptr<Stepper<double>> make_stepper(const std::string& method, System<double>& system,
                                              const StepperOptions& options);
/// The methods of `make_stepper`, in the order of the documentation.
const std::vector<std::string>& stepper_methods();

}  // namespace flyball
