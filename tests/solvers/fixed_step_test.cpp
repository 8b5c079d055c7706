#include "solvers/fixed_step.h"

#include <cmath>

#include "blocks/jet.h"
#include "tests/catch.h"
#include "tests/solvers/problems.h"

using namespace flyball;
using namespace flyball::test;

namespace {

const StepperOptions steps_of_a_tenth = {.fixed_step = 0.1};

template <template <class> class Method>
std::vector<double> ends(double limit, double then) {
  auto system = make_system(1, [](double, const double*, double* dx) { dx[0] = 1.0; });
  Method<double> stepper(system, steps_of_a_tenth);
  StepMemory memory;
  const double x = 0.0;
  stepper.restart(0.0, &x, memory, true);
  std::vector<double> all;
  const auto see = [&](double t) {
    all.push_back(t);
    CHECK(system.last_time == t);
  };
  run(stepper, limit, memory, see);
  run(stepper, then, memory, see);
  return all;
}

}  // namespace

TEST_CASE("Fixed steps end on exact multiples and on limits between them") {
  const std::vector<double> expected = {0.1, 0.2, 0.25, 3 * 0.1, 4 * 0.1};
  CHECK(ends<Euler>(0.25, 0.4) == expected);
  CHECK(ends<RungeKutta4>(0.25, 0.4) == expected);
}

TEST_CASE("Fixed steps do not drift") {
  auto system = make_system(1, [](double, const double*, double* dx) { dx[0] = 1.0; });
  Euler<double> stepper(system, steps_of_a_tenth);
  StepMemory memory;
  const double x = 0.0;
  stepper.restart(0.0, &x, memory, true);
  double t = 0.0;
  for (int k = 0; k < 100000; ++k) t = stepper.step(1e9, memory);
  CHECK(t == 100000 * 0.1);  // adding 0.1 a hundred thousand times gives 10000.00000002
}

TEST_CASE("Fixed steps count from the last restart") {
  auto system = make_system(1, [](double, const double*, double* dx) { dx[0] = 1.0; });
  RungeKutta4<double> stepper(system, steps_of_a_tenth);
  StepMemory memory;
  const double x = 0.0;
  stepper.restart(0.0, &x, memory, true);
  stepper.step(0.03, memory);
  stepper.restart(0.03, stepper.state(), memory, false);
  CHECK(stepper.step(1.0, memory) == 0.03 + 0.1);
}

TEST_CASE("rk4 evaluates four rates a step") {
  const Problem problem = oscillator();
  auto system = make_system(2, problem.rates);
  RungeKutta4<double> stepper(system, steps_of_a_tenth);
  StepMemory memory;
  stepper.restart(0.0, problem.start.data(), memory, true);
  run(stepper, 1.0, memory, [](double) {});
  CHECK(system.calls == 1 + 4 * 10);
  CHECK(stepper.statistics().rate_evaluations == system.calls);
  CHECK(stepper.statistics().steps == 10);
}

TEST_CASE("rk4 differentiates through its steps") {
  // x' = -p x: dx/dp = -t x. Error of rk4 with steps of 0.1: about (p h)^4 / 120 relative, of the derivative
  // five times that.
  auto system = make_system<Jet>(1, [](Jet, const Jet* x, Jet* dx) { dx[0] = -Jet(2.0, 0) * x[0]; });
  RungeKutta4<Jet> stepper(system, steps_of_a_tenth);
  StepMemory memory;
  const Jet x(1.0);
  stepper.restart(Jet(0.0), &x, memory, true);
  run(stepper, Jet(1.0), memory, [](const Jet&) {});
  CHECK(std::fabs(stepper.state()[0].v[0] + std::exp(-2.0)) < 1e-4 * std::exp(-2.0));
}

TEST_CASE("Fixed steps work without states") {
  auto system = make_system(0, [](double, const double*, double*) {});
  RungeKutta4<double> stepper(system, steps_of_a_tenth);
  StepMemory memory;
  const double none = 0.0;
  stepper.restart(0.0, &none, memory, true);
  run(stepper, 1.0, memory, [&](double t) { CHECK(system.last_time == t); });
  CHECK(stepper.statistics().steps == 10);
}
