#include "solvers/exact_step.h"

#include <cmath>
#include <limits>

#include "solvers/errors.h"
#include "tests/catch.h"
#include "tests/solvers/problems.h"

namespace flyball::test {
namespace {

/// x' = A x + b, two states, whose matrix the method may ask for.
class LinearSystem final : public System<double> {
 public:
  std::vector<double> a, b;
  bool known = true;

  LinearSystem(std::vector<double> matrix, std::vector<double> offset)
      : a(std::move(matrix)), b(std::move(offset)) {}

  int size() const override { return 2; }
  void rates(double, const double* x, double* dx) override {
    for (int i = 0; i < 2; ++i) dx[i] = a[2 * i] * x[0] + a[2 * i + 1] * x[1] + b[i];
  }
  std::string state_name(int i) const override { return "plant.x" + std::to_string(i + 1); }
  const Sparsity& pattern() const override { throw std::logic_error("no Jacobian"); }
  void jacobian(double, const double*, double*) override { throw std::logic_error("no Jacobian"); }
  const std::vector<double>* linear_part() const override { return known ? &a : nullptr; }
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
  system.a[0] = -3.0;
  const std::vector<double> middle(stepper.state(), stepper.state() + 2);
  stepper.restart(1.0, middle.data(), memory, true);
  stepper.step(2.0, memory);
  CHECK(stepper.state()[0] == Approx(std::exp(-4.0)).epsilon(20.0 * epsilon));
  CHECK(stepper.state()[1] == Approx(2.0 * std::exp(-2.0)).epsilon(20.0 * epsilon));
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
