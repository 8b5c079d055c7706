#pragma once

#include <vector>

#include "solvers/stepper.h"

namespace flyball {

/// The exact solution of x' = A x + b between two instants: x(t + h) = x(t) + P(h) x'(t) with
/// P(h) = h phi_1(h A) = h + h^2 A/2! + h^3 A^2/3! + …; no error but rounding, whatever the step. For plants
/// that are driven by held values, and switched linear diagrams. Where the rates are not affine in the states
/// with constant coefficients, `step` throws SimulationError (solver).
class ExactStep final : public Stepper<double> {
 public:
  ExactStep(System<double>& system, const StepperOptions& options);

  void restart(double t, const double* x, StepMemory& memory, bool changed) override;
  double step(double limit, StepMemory& memory) override;
  const double* state() const override { return after_.data(); }
  void interpolate(double t, double* x) override;
  bool ends_with_rates() const override { return false; }

 private:
  using Matrix = std::vector<double>;  // by rows

  /// P(h) for some length, of the matrix that it was made from.
  struct Propagator {
    double length = 0.0;
    Matrix of;
    Matrix value;
  };

  const Matrix& linear_part() const;
  const Matrix& propagator(double length);
  void propagate(double length, const Matrix& a, Matrix& result);
  void advance(const Matrix& propagator, double* x) const;
  void multiply(const Matrix& a, const Matrix& b, Matrix& result) const;

  System<double>& system_;
  StepperOptions options_;
  int size_;
  double begin_ = 0.0, end_ = 0.0;
  bool rate_after_known_ = false;  // after an instant it is asked for anyway
  std::vector<double> before_, after_, rate_before_, rate_after_;
  std::vector<Propagator> known_;  // the last few lengths: ticks of several rates give several
  std::size_t oldest_ = 0;
  Matrix term_, product_, inside_;
};

}  // namespace flyball
