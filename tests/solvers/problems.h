#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "solvers/stepper.h"

namespace flyball::test {

/// x' = f(t, x) from a function object `f(t, x, dx)`, for any scalar that the function takes. No Jacobian.
template <class T, class F>
class FunctionSystem : public System<T> {
 public:
  FunctionSystem(int size, F f) : size_(size), f_(std::move(f)) {}

  int size() const override { return size_; }
  void rates(T t, const T* x, T* dx) override {
    f_(t, x, dx);
    last_time = t;
    ++calls;
  }
  std::string state_name(int i) const override { return "plant.x" + std::to_string(i + 1); }
  const Sparsity& pattern() const override { throw std::logic_error("no Jacobian"); }
  void jacobian(double, const double*, double*) override { throw std::logic_error("no Jacobian"); }

  T last_time{};
  long calls = 0;

 private:
  int size_;
  F f_;
};

template <class T = double, class F>
FunctionSystem<T, F> make_system(int size, F f) {
  return {size, std::move(f)};
}

/// An initial value problem on [begin, stop] with a closed form for its first state.
struct Problem {
  std::string name;
  std::vector<double> start;
  double begin, stop;
  std::function<void(double, const double*, double*)> rates;
  std::function<double(double)> first_state;
};

inline Problem logistic() {
  return {"logistic",
          {0.25},
          0.0,
          4.0,
          [](double, const double* x, double* dx) { dx[0] = x[0] * (1.0 - x[0]); },
          [](double t) { return 1.0 / (1.0 + 3.0 * std::exp(-t)); }};
}

inline Problem oscillator() {
  return {"oscillator",
          {1.0, 0.5},
          0.0,
          4.0,
          [](double, const double* x, double* dx) {
            dx[0] = x[1];
            dx[1] = -x[0];
          },
          [](double t) { return std::cos(t) + 0.5 * std::sin(t); }};
}

/// Its rates depend on time. It does not begin at 0, where symmetry removes terms of the error.
inline Problem bell() {
  return {"bell",
          {2.0},
          0.25,
          1.75,
          [](double t, const double* x, double* dx) { dx[0] = -2.0 * t * x[0]; },
          [](double t) { return 2.0 * std::exp(0.0625 - t * t); }};
}

/// The ends of the steps from the stepper's restart to `stop`, with what `see` makes of each.
template <class T, class See>
void run(Stepper<T>& stepper, T stop, StepMemory& memory, See&& see) {
  for (T t = stepper.step(stop, memory);; t = stepper.step(stop, memory)) {
    see(t);
    if (value_of(t) >= value_of(stop)) return;
  }
}

}  // namespace flyball::test
