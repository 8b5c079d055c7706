#pragma once

#include <vector>

#include "solvers/stepper.h"

namespace flyball {

/// The exact solution of x' = A x + B w + b between two instants, where w stands still:
/// x(t + h) = x(t) + P(h) x'(t) with P(h) = h phi_1(h A) = h + h^2 A/2! + h^3 A^2/3! + …; no error but
/// rounding, whatever the step. For plants that are driven by held values, and switched linear diagrams.
/// Where the rates are not of this kind, `step` throws SimulationError (solver).
class ExactStep final : public Stepper<double> {
 public:
  ExactStep(System<double>& system, const StepperOptions& options);

  void restart(double t, const double* x, StepMemory& memory, bool changed) override;
  double step(double limit, StepMemory& memory) override;
  const double* state() const override { return after_.data(); }
  void interpolate(double t, double* x) override;
  bool ends_with_rates() const override { return false; }

  /// The restart of an instant that changed neither states nor bits.
  void hold() {
    ++statistics_.restarts;
    system_.held_inputs(after_.data() + size_);
  }
  /// LinearRates::largest from the last restart to the next.
  double largest() const { return linear_ != nullptr ? linear_->largest : 0.0; }

 private:
  using Matrix = std::vector<double>;  // by rows
  /// x = z + g + columns z for the states and inputs z, of which the states are the first.
  using Move = void (*)(const double* columns, const double* z, int count, double* x, int n);

  /// A step of some length: the columns of P A and P B, then P b.
  struct Leap {
    double length = 0.0;
    std::vector<double> columns;
  };

  void forget();
  const LinearRates& linear() const;
  const Leap& leap(double length);
  void write(Leap& leap) const;
  void propagate(double length, const Matrix& a, Matrix& result);
  void multiply(const Matrix& a, const Matrix& b, Matrix& result) const;
  void go(const Leap& leap, double* x) const {
    move_(leap.columns.data(), before_.data(), static_cast<int>(before_.size()), x, size_);
  }
  void require_finite();

  System<double>& system_;
  StepperOptions options_;
  int size_;
  Move move_;
  const LinearRates* linear_ = nullptr;
  long version_ = 0;  // of `linear_`, for which `known_` holds
  double begin_ = 0.0, end_ = 0.0;
  std::vector<double> before_, after_, rate_;  // `before_` with the inputs behind it
  std::vector<Leap> known_;                    // the last few lengths: ticks of several rates give several
  std::size_t latest_ = 0, oldest_ = 0;
  Leap inside_;
  Matrix propagator_, term_, product_;
};

}  // namespace flyball
