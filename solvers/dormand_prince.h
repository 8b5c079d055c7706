#pragma once

#include <vector>

#include "solvers/reach.h"
#include "solvers/stepper.h"

namespace flyball {

/// Dormand and Prince's explicit Runge-Kutta pair of orders 5 and 4: six rates a step (the last is the first
/// of the next step), a fourth-order continuous extension, steps chosen by a PI controller.
///
/// The error of a step is sqrt(mean((e / (atol + rtol max(|x0|, |x1|)))^2)) and at most 1. Unless
/// StepperOptions::derivative_errors, steps are chosen by values alone, so that derivatives in T are those of
/// the steps that were taken; else the same bound holds for each direction. A step that lands on a limit
/// carries the limit's derivatives. A step that the limit shortens never makes the remembered size smaller.
///
/// Source: Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, 2nd ed., tables II.5.2
/// (method) and section II.6 (extension), p. 169 (first step); E. Hairer's dopri5.f (controller).
template <class T>
class DormandPrince final : public Stepper<T> {
 public:
  DormandPrince(System<T>& system, const StepperOptions& options);

  /// One evaluation of the rates; none when nothing changed at the end of the last step.
  void restart(T t, const T* x, StepMemory& memory, bool changed) override;
  T step(T limit, StepMemory& memory) override;
  const T* state() const override { return row(after); }
  void interpolate(T t, T* x) override { extension()->states(t, x); }
  bool ends_with_rates() const override { return true; }
  std::optional<Extension<T>> extension() override;
  int limiting_state() const override;

  /// h |lambda| of the last step, where lambda is the largest eigenvalue that the difference of its last two
  /// stages shows, measured as errors are; 0 when these are equal. On the negative real axis the method is
  /// stable up to 3.3. Source: Hairer, Wanner, Solving Ordinary Differential Equations II, section IV.2.
  double step_times_stiffness() const;

 private:
  // Rows of the storage. The seven rates come first, so that the rate of stage j is row j; from `before` to
  // `trial` stand the rows of the extension.
  static constexpr int stages = 7, last_rate = 6, before = 7, after = 8, trial = 12, rows = 13;

  T* row(int r) { return storage_.data() + r * size_; }
  const T* row(int r) const { return storage_.data() + r * size_; }

  T idle_step(T limit);
  void continue_from_end();
  double first_step(double remaining);
  void attempt(T end);
  void extend();
  template <std::size_t N>
  void stage(const double (&a)[N], T t, int target);
  T error_of(int i) const;
  double weighted_error(int i) const;
  double error_norm() const;
  void remember(double error, const Reach& taken, bool rejected, StepMemory& memory) const;
  [[noreturn]] void fail(double next) const;

  System<T>& system_;
  StepperOptions options_;
  int size_;
  std::vector<T> storage_;
  T begin_, end_, taken_;  // the last step [s]; taken_ is end_ - begin_
  bool extended_ = false;  // whether the continuous extension of this step has been prepared
};

}  // namespace flyball
