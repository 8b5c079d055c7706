#pragma once

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <vector>

#include "solvers/stepper.h"

namespace flyball {

/// Steps that end on t0 + k h, counted from the last restart so that rounding does not add up, and on limits
/// between. The rates at the end of a step are the first rates of the next.
template <class T>
class FixedStep : public Stepper<T> {
 public:
  FixedStep(System<T>& system, const StepperOptions& options, int scratch_rows)
      : system_(system),
        size_(system.size()),
        storage_(static_cast<std::size_t>((shared_rows + scratch_rows) * size_), T(0.0)),
        step_(options.fixed_step),
        origin_(std::numeric_limits<double>::quiet_NaN()),
        begin_(origin_),
        end_(origin_),
        taken_(0.0) {
    if (!(step_ > 0.0)) throw std::invalid_argument("a fixed-step method needs a fixed_step above 0");
  }

  void restart(T t, const T* x, StepMemory&, bool changed) override {
    const bool rates_hold = !changed && value_of(t) == value_of(end_);
    origin_ = end_ = t;
    count_ = 0;
    if (rates_hold) return;
    std::copy(x, x + size_, row(after));
    evaluate(t, row(after), row(rate_after));
    ++this->statistics_.restarts;
  }

  T step(T limit, StepMemory&) override {
    if (value_of(limit) < value_of(end_)) throw std::logic_error("a step to a limit in the past");
    begin_ = end_;
    extended_ = false;
    std::copy(row(after), row(after) + size_, row(before));
    std::copy(row(rate_after), row(rate_after) + size_, row(rate_before));
    end_ = next_end(limit);
    taken_ = end_ - begin_;
    advance();
    evaluate(end_, row(after), row(rate_after));
    ++this->statistics_.steps;
    return end_;
  }

  const T* state() const override { return row(after); }
  bool ends_with_rates() const override { return true; }
  void interpolate(T t, T* x) override { extension()->states(t, x); }
  std::optional<Extension<T>> extension() override {
    if (!extended_) extend();
    extended_ = true;
    return Extension<T>{begin_, taken_, row(before), size_};
  }

 protected:
  // The first five are those of the extension.
  static constexpr int before = 0, after = 1, rate_before = 5, rate_after = 6, shared_rows = 7;

  /// Fills the row `after` from `before` and `rate_before`.
  virtual void advance() = 0;
  /// Fills the inner rows of the extension: cubic Hermite interpolation (order 3).
  virtual void extend() { fill_hermite(taken_, row(rate_before), row(rate_after), row(before), size_); }

  T* row(int r) { return storage_.data() + r * size_; }
  const T* row(int r) const { return storage_.data() + r * size_; }
  int size() const { return size_; }
  T begin() const { return begin_; }
  T taken() const { return taken_; }
  void evaluate(T t, const T* x, T* rates) {
    system_.rates(t, x, rates);
    ++this->statistics_.rate_evaluations;
  }

 private:
  T next_end(T limit) {
    const double rounding = 1e-9 * step_;  // far above that of t, far below a step worth taking
    const T target = origin_ + static_cast<double>(count_ + 1) * step_;
    const bool lands = value_of(limit) - value_of(target) <= rounding;
    const T end = lands ? limit : target;
    if (value_of(target) - value_of(end) <= rounding) ++count_;
    return end;
  }

  System<T>& system_;
  int size_;
  std::vector<T> storage_;
  double step_;
  long count_ = 0;
  T origin_, begin_, end_, taken_;
  bool extended_ = false;
};

/// Euler's method: order 1, linear in between.
template <class T>
class Euler final : public FixedStep<T> {
  using Base = FixedStep<T>;

 public:
  Euler(System<T>& system, const StepperOptions& options) : Base(system, options, 0) {}

 private:
  void extend() override {}
  void advance() override {
    const T *x = this->row(Base::before), *rate = this->row(Base::rate_before);
    T* y = this->row(Base::after);
    for (int i = 0; i < this->size(); ++i) y[i] = x[i] + this->taken() * rate[i];
  }
};

/// Heun's method, the explicit trapezoidal rule: order 2, cubic Hermite in between.
template <class T>
class Heun final : public FixedStep<T> {
  using Base = FixedStep<T>;

 public:
  Heun(System<T>& system, const StepperOptions& options) : Base(system, options, 2) {}

 private:
  static constexpr int euler = Base::shared_rows, euler_rate = euler + 1;

  void advance() override {
    const T h = this->taken();
    const T *x = this->row(Base::before), *k1 = this->row(Base::rate_before);
    T *along = this->row(euler), *k2 = this->row(euler_rate), *y = this->row(Base::after);
    for (int i = 0; i < this->size(); ++i) along[i] = x[i] + h * k1[i];
    this->evaluate(this->begin() + h, along, k2);
    for (int i = 0; i < this->size(); ++i) y[i] = x[i] + 0.5 * h * (k1[i] + k2[i]);
  }
};

/// The classical Runge-Kutta method: order 4, cubic Hermite in between.
template <class T>
class RungeKutta4 final : public FixedStep<T> {
  using Base = FixedStep<T>;

 public:
  RungeKutta4(System<T>& system, const StepperOptions& options) : Base(system, options, 4) {}

 private:
  static constexpr int trial = Base::shared_rows, rate_2 = trial + 1, rate_3 = trial + 2, rate_4 = trial + 3;

  void advance() override {
    const T t = this->begin(), h = this->taken();
    evaluate_at(t + 0.5 * h, 0.5 * h, Base::rate_before, rate_2);
    evaluate_at(t + 0.5 * h, 0.5 * h, rate_2, rate_3);
    evaluate_at(t + h, h, rate_3, rate_4);
    const T *x = this->row(Base::before), *k1 = this->row(Base::rate_before);
    const T *k2 = this->row(rate_2), *k3 = this->row(rate_3), *k4 = this->row(rate_4);
    T* y = this->row(Base::after);
    for (int i = 0; i < this->size(); ++i) {
      y[i] = x[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
    }
  }

  void evaluate_at(T t, T along, int rate, int target) {
    const T *x = this->row(Base::before), *k = this->row(rate);
    T* y = this->row(trial);
    for (int i = 0; i < this->size(); ++i) y[i] = x[i] + along * k[i];
    this->evaluate(t, y, this->row(target));
  }
};

}  // namespace flyball
