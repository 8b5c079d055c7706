#include "solvers/exact_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "solvers/errors.h"
#include "tests/catch.h"
#include "tests/solvers/problems.h"

namespace flyball::test {
namespace {

/// x' = A x + B w + b, two states and at most one input.
class LinearSystem final : public System<double> {
 public:
  LinearRates linear;
  double w = 0.0;
  bool known = true;

  LinearSystem(std::vector<double> matrix, std::vector<double> offset, std::vector<double> inputs = {})
      : linear{.matrix = std::move(matrix),
               .inputs = std::move(inputs),
               .offset = std::move(offset),
               .version = 1} {}

  int size() const override { return 2; }
  void rates(double, const double* x, double* dx) override {
    const auto& [a, b, offset, largest, version] = linear;
    for (int i = 0; i < 2; ++i) {
      dx[i] = a[2 * i] * x[0] + a[2 * i + 1] * x[1] + offset[i] + (b.empty() ? 0.0 : b[i] * w);
      if (!std::isfinite(dx[i])) throw std::range_error(state_name(i));
    }
  }
  std::string state_name(int i) const override { return "plant.x" + std::to_string(i + 1); }
  const Sparsity& pattern() const override { throw std::logic_error("no Jacobian"); }
  void jacobian(double, const double*, double*) override { throw std::logic_error("no Jacobian"); }
  const LinearRates* linear_rates() override { return known ? &linear : nullptr; }
  void held_inputs(double* inputs) const override {
    if (!linear.inputs.empty()) *inputs = w;
  }
};

StepperOptions options(double max_step) {
  StepperOptions result;
  result.max_step = max_step;
  return result;
}

constexpr double epsilon = std::numeric_limits<double>::epsilon();

}  // namespace

TEST_CASE("exact steps follow a damped oscillation, whatever their length") {
  // x'' + 2 d x' + (w^2 + d^2) x = 0 from (1, 0): x = e^-dt (cos wt + d/w sin wt).
  const double d = 0.3, w = 4.0;
  LinearSystem system({0.0, 1.0, -(w * w + d * d), -2.0 * d}, {0.0, 0.0});
  const auto exact = [&](double t) { return std::exp(-d * t) * (std::cos(w * t) + d / w * std::sin(w * t)); };
  for (const double h : {0.01, 0.37, 3.0}) {
    ExactStep stepper(system, options(h));
    StepMemory memory;
    const double start[] = {1.0, 0.0};
    stepper.restart(0.0, start, memory, true);
    double t = 0.0;
    while (t < 6.0) t = stepper.step(6.0, memory);
    CHECK(t == 6.0);
    // Each step multiplies by a matrix of norm about w, and rounds: a few units a step, and those of
    // doubling.
    CHECK(std::fabs(stepper.state()[0] - exact(6.0)) < 100.0 * epsilon * (6.0 / h + 10.0));
    double inside[2];
    const double at = 6.0 - 0.3 * h;
    stepper.interpolate(at, inside);
    CHECK(std::fabs(inside[0] - exact(at)) < 100.0 * epsilon * (6.0 / h + 10.0));
  }
}

TEST_CASE("exact steps need no inverse: a double integrator under a constant force") {
  LinearSystem system({0.0, 1.0, 0.0, 0.0}, {0.0, 2.0});
  ExactStep stepper(system, options(10.0));
  StepMemory memory;
  const double start[] = {1.0, -3.0};
  stepper.restart(0.0, start, memory, true);
  stepper.step(5.0, memory);
  // Small integers: all is exact.
  CHECK(stepper.state()[0] == 1.0 - 15.0 + 25.0);
  CHECK(stepper.state()[1] == -3.0 + 10.0);
}

TEST_CASE("exact steps notice that the matrix has changed at an instant") {
  LinearSystem system({-1.0, 0.0, 0.0, -1.0}, {0.0, 0.0});
  ExactStep stepper(system, options(10.0));
  StepMemory memory;
  const double start[] = {1.0, 2.0};
  stepper.restart(0.0, start, memory, true);
  stepper.step(1.0, memory);
  system.linear.matrix[0] = -3.0;
  ++system.linear.version;
  const std::vector<double> middle(stepper.state(), stepper.state() + 2);
  stepper.restart(1.0, middle.data(), memory, true);
  stepper.step(2.0, memory);
  CHECK(stepper.state()[0] == Approx(std::exp(-4.0)).epsilon(20.0 * epsilon));
  CHECK(stepper.state()[1] == Approx(2.0 * std::exp(-2.0)).epsilon(20.0 * epsilon));
}

TEST_CASE("exact steps hold an input from one restart to the next") {
  // v' = 2 w, x' = v from rest, with w = 1 for 2 s and then -3: small integers, so all is exact.
  LinearSystem system({0.0, 1.0, 0.0, 0.0}, {0.0, 0.0}, {0.0, 2.0});
  ExactStep stepper(system, options(10.0));
  StepMemory memory;
  double x[] = {0.0, 0.0};
  system.w = 1.0;
  stepper.restart(0.0, x, memory, true);
  system.w = 5.0;  // not seen before the restart
  stepper.step(2.0, memory);
  CHECK(stepper.state()[0] == 4.0);
  CHECK(stepper.state()[1] == 4.0);
  stepper.step(3.0, memory);  // and on, without a restart
  CHECK(stepper.state()[0] == 9.0);
  CHECK(stepper.state()[1] == 6.0);
  x[0] = x[1] = 4.0;
  system.w = -3.0;
  stepper.restart(2.0, x, memory, true);
  stepper.step(4.0, memory);
  CHECK(stepper.state()[0] == 4.0 + 8.0 - 12.0);
  CHECK(stepper.state()[1] == 4.0 - 12.0);
  double inside[2];
  stepper.interpolate(3.0, inside);
  CHECK(inside[0] == 4.0 + 4.0 - 3.0);
  CHECK(inside[1] == 4.0 - 6.0);
}

TEST_CASE("exact steps ask for the rates where a state is no longer finite: they have names") {
  LinearSystem system({0.0, 1.0, 0.0, 0.0}, {0.0, 1e308});
  ExactStep stepper(system, options(100.0));
  StepMemory memory;
  const double start[] = {0.0, 0.0};
  stepper.restart(0.0, start, memory, true);
  stepper.step(100.0, memory);  // the state overflows, its rate does not: whoever reads the state tells
  CHECK_FALSE(std::isfinite(stepper.state()[1]));
  stepper.restart(100.0, stepper.state(), memory, true);
  CHECK_THROWS_WITH(stepper.step(200.0, memory), "plant.x1");
}

TEST_CASE("exact steps refuse a system that is not affine") {
  LinearSystem system({0.0, 1.0, 0.0, 0.0}, {0.0, 0.0});
  system.known = false;
  ExactStep stepper(system, options(10.0));
  StepMemory memory;
  const double start[] = {1.0, 1.0};
  stepper.restart(0.0, start, memory, true);
  CHECK_THROWS_WITH(
      stepper.step(1.0, memory),
      "the method \"exact\" needs rates that are affine in a few states and do not depend on time "
      "during a step; \"dp5\" does without");
}

}  // namespace flyball::test
