#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

namespace flyball::bench {

/// The coefficients of Dormand and Prince's pair and of its continuous extension, and the controller of
/// E. Hairer's dopri5.f.
/// Source: Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, 2nd ed., table II.5.2.
namespace dopri5 {
inline constexpr double c[] = {0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0};
inline constexpr double a[7][6] = {
    {},
    {1.0 / 5.0},
    {3.0 / 40.0, 9.0 / 40.0},
    {44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0},
    {19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0},
    {9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0},
    {35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0}};
inline constexpr double e[] = {71.0 / 57600.0,      0.0,          -71.0 / 16695.0, 71.0 / 1920.0,
                               -17253.0 / 339200.0, 22.0 / 525.0, -1.0 / 40.0};
inline constexpr double d[] = {-12715105075.0 / 11282082432.0,  0.0,
                               87487479700.0 / 32700410799.0,   -10690763975.0 / 1880347072.0,
                               701980252875.0 / 199316789632.0, -1453857185.0 / 822651844.0,
                               69997945.0 / 29380423.0};
inline constexpr double safety = 0.9, beta = 0.04, exponent = 0.2 - 0.75 * beta;

/// Chooses the step sizes. `error` is the square of the weighted error, at most 1 for a step that is
/// accepted. One logarithm and one exponential a step; powers of both errors would take twice that.
class Controller {
 public:
  double after_accepted(double size, double error, bool was_rejected) {
    const double logarithm = std::max(0.5 * std::log(error), std::log(1e-4));
    const double shrink = std::exp(exponent * logarithm - beta * last_) / safety;
    last_ = logarithm;
    const double next = size / std::clamp(shrink, 1.0 / 10.0, 1.0 / 0.2);
    return was_rejected ? std::min(next, size) : next;
  }
  double after_rejected(double size, double error) const {
    return size / std::min(1.0 / 0.2, std::exp(0.5 * exponent * std::log(error)) / safety);
  }

 private:
  double last_ = std::log(1e-4);
};

}  // namespace dopri5

/// A quartic over one step, in powers of the fraction theta of the step.
template <class T>
struct QuarticOf {
  T c0, c1, c2, c3, c4;
  T operator()(double theta) const { return c0 + theta * (c1 + theta * (c2 + theta * (c3 + theta * c4))); }
};
using Quartic = QuarticOf<double>;

/// The value of a number or of a Jet.
template <class T>
double number(const T& x) {
  if constexpr (std::is_same_v<T, double>) {
    return x;
  } else {
    return x.a;
  }
}

/// What a good engineer writes for one small system: Dormand-Prince with everything inlined, no heap, the
/// step size kept across hits and events. `Rates` is called as rates(t, x, dx). On Jets, steps are chosen by
/// values.
template <int n, class Rates, class T = double>
class Dopri5 {
 public:
  using State = std::array<T, n>;

  Dopri5(const Rates& system, double rtol, double atol, double first_step, double max_step)
      : rates(system), rtol_(rtol), atol_(atol), max_step_(max_step), next_(first_step) {}

  /// Begins at (t, x). The step size stays what it was.
  void restart(double t, const State& x) {
    end_ = t;
    x1_ = x;
    rates(t, x1_, k_[6]);
  }

  /// One accepted step, not beyond `limit`. What lands on the limit early does not shrink the next step.
  double step(double limit) {
    begin_ = end_;
    x0_ = x1_;
    k_[0] = k_[6];
    const double remaining = limit - begin_;
    for (bool rejected = false;; rejected = true) {
      const bool lands = remaining <= 1.01 * next_;
      const bool halves = !lands && remaining < 2.0 * next_;
      size_ = lands ? remaining : halves ? 0.5 * remaining : next_;
      end_ = lands ? limit : begin_ + size_;
      const double error = attempt();
      if (!(error <= 1.0)) {
        next_ = controller_.after_rejected(size_, error);
        continue;
      }
      const double next = controller_.after_accepted(size_, error, rejected);
      if (size_ >= next_ || next > next_ || rejected) next_ = std::min(next, max_step_);
      return end_;
    }
  }

  double begin() const { return begin_; }
  double end() const { return end_; }
  double size() const { return size_; }
  const State& state() const { return x1_; }

  /// The continuous extension of one component over the last step.
  QuarticOf<T> extension(int i) const {
    const T change = x1_[i] - x0_[i];
    const T first = size_ * k_[0][i] - change;
    const T last = change - size_ * k_[6][i] - first;
    T bubble = dopri5::d[0] * k_[0][i];
#pragma GCC unroll 8
    for (int j = 2; j < 7; ++j) bubble += dopri5::d[j] * k_[j][i];
    bubble *= size_;
    // x0 + theta (change + (1 - theta) (first + theta (last + (1 - theta) bubble))), in powers of theta.
    return {x0_[i], change + first, last + bubble - first, -last - 2.0 * bubble, bubble};
  }

  Rates rates;

 private:
  double attempt() {
    State x;
    stage<1>(x);
    stage<2>(x);
    stage<3>(x);
    stage<4>(x);
    stage<5>(x);
    stage<6>(x1_);
    double sum = 0.0;
#pragma GCC unroll 8
    for (int i = 0; i < n; ++i) {
      double error = dopri5::e[0] * number(k_[0][i]);
#pragma GCC unroll 8
      for (int j = 2; j < 7; ++j) error += dopri5::e[j] * number(k_[j][i]);
      const double scale = atol_ + rtol_ * std::max(std::fabs(number(x0_[i])), std::fabs(number(x1_[i])));
      const double weighted = size_ * error / scale;
      sum += weighted * weighted;
    }
    return sum / n;
  }

  template <int s>
  void stage(State& x) {
#pragma GCC unroll 8
    for (int i = 0; i < n; ++i) {
      T sum = dopri5::a[s][0] * k_[0][i];
#pragma GCC unroll 8
      for (int j = 1; j < s; ++j) {
        if (dopri5::a[s][j] != 0.0) sum += dopri5::a[s][j] * k_[j][i];
      }
      x[i] = x0_[i] + size_ * sum;
    }
    rates(begin_ + dopri5::c[s] * size_, x, k_[s]);
  }

  double rtol_, atol_, max_step_;
  dopri5::Controller controller_;
  State x0_{}, x1_{}, k_[7]{};
  double begin_ = 0.0, end_ = 0.0, size_ = 0.0, next_;
};

}  // namespace flyball::bench
