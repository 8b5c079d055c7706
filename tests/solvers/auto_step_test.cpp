#include "solvers/auto_step.h"

#include <cmath>

#include "tests/catch.h"
#include "tests/solvers/stiff_systems.h"

using namespace flyball;
using namespace flyball::test;

namespace {

/// x1' = rate (cos t - x1), x2' = -x2 from (0, 1): x1 = rate (rate cos t + sin t - rate e^(-rate t)) /
/// (rate^2 + 1). Hairer, Wanner II, section IV.1, with a second state that is not stiff.
auto curtiss_hirschfelder(double rate) {
  const auto rates = [rate](double t, const double* x, double* dx) {
    dx[0] = rate * (std::cos(t) - x[0]);
    dx[1] = -x[1];
  };
  const auto jacobian = [rate](double, const double*, double* values) {
    values[0] = -rate;
    values[1] = values[2] = 0.0;
    values[3] = -1.0;
  };
  return StiffSystem(dense_pattern(2), rates, jacobian);
}

double first_state(double rate, double t) {
  return rate * (rate * std::cos(t) + std::sin(t) - rate * std::exp(-rate * t)) / (rate * rate + 1.0);
}

constexpr StepperOptions tight = {.rtol = 1e-6, .atol = 1e-8, .max_step = 1.0};
constexpr double start[] = {0.0, 1.0};

}  // namespace

TEST_CASE("dp5 measures h |lambda|") {
  auto system = make_system(2, [](double, const double* x, double* dx) {
    dx[0] = -50.0 * x[0];
    dx[1] = -x[1];
  });
  DormandPrince<double> stepper(system, {.rtol = 1e6, .atol = 1e6, .max_step = 0.01});
  StepMemory memory{.size = 0.01};
  const double x[] = {1.0, 0.0};
  stepper.restart(0.0, x, memory, true);
  stepper.step(1.0, memory);
  // Of a linear rate the quotient is exact, but for the rounding of differences of 1e-4 of the states.
  CHECK(stepper.step_times_stiffness() == Approx(0.5).epsilon(1e-10));
}

TEST_CASE("dp5 finds no stiffness in what stands still") {
  auto system = make_system(1, [](double, const double*, double* dx) { dx[0] = 0.0; });
  DormandPrince<double> stepper(system, tight);
  StepMemory memory;
  stepper.restart(0.0, start, memory, true);
  stepper.step(1.0, memory);
  CHECK(stepper.step_times_stiffness() == 0.0);
}

TEST_CASE("dp5 names the state that limits its step") {
  auto system = curtiss_hirschfelder(1e4);
  DormandPrince<double> stepper(system, tight);
  StepMemory memory;
  stepper.restart(0.0, start, memory, true);
  for (int k = 0; k < 100; ++k) stepper.step(10.0, memory);
  CHECK(stepper.limiting_state() == 0);
}

TEST_CASE("auto turns to BDF where stability limits the steps") {
  const double rate = 1e4;
  auto system = curtiss_hirschfelder(rate);
  AutoStep stepper(system, tight);
  StepMemory memory;
  stepper.restart(0.0, start, memory, true);
  double worst = 0.0;
  run(stepper, 10.0, memory,
      [&](double t) { worst = std::max(worst, std::fabs(stepper.state()[0] - first_state(rate, t))); });
  // 15 stable steps, each at most 3.3 time constants, give it away; behind some 15 in the transient, and up
  // to ten that are not tested.
  CHECK(memory.stiff_since > 0.0);
  CHECK(memory.stiff_since < 40.0 * 3.3 / rate);
  CHECK(memory.stiffest_state == 0);
  // Stable explicit steps of 3.3 time constants would be 30 000.
  CHECK(stepper.statistics().steps < 1000);
  CHECK(stepper.statistics().rate_evaluations == system.calls);
  CHECK(stepper.statistics().jacobians > 0);
  // Errors are forgotten within the stiff time constant: a few tolerances of BDF steps.
  CHECK(worst < 20.0 * (tight.atol + tight.rtol));
}

TEST_CASE("auto stays explicit where max_step is the limit") {
  auto system = curtiss_hirschfelder(1.0);
  StepperOptions short_steps = tight;
  short_steps.rtol = short_steps.atol = 1e3;
  short_steps.max_step = 2.0;  // of h |lambda| = 2
  AutoStep stepper(system, short_steps);
  StepMemory memory{.size = 2.0};
  stepper.restart(0.0, start, memory, true);
  run(stepper, 200.0, memory, [](double) {});
  CHECK(stepper.statistics().steps == 100);
  CHECK(std::isinf(memory.stiff_since));
}

TEST_CASE("auto is dp5 to the bit where nothing is stiff") {
  const Problem problem = oscillator();
  auto one = make_system(2, problem.rates), other = make_system(2, problem.rates);
  AutoStep automatic(one, tight);
  DormandPrince<double> explicit_steps(other, tight);
  StepMemory memory, explicit_memory;
  automatic.restart(0.0, problem.start.data(), memory, true);
  explicit_steps.restart(0.0, problem.start.data(), explicit_memory, true);
  run(automatic, 200.0, memory, [&](double t) {
    REQUIRE(explicit_steps.step(200.0, explicit_memory) == t);
    REQUIRE(automatic.state()[0] == explicit_steps.state()[0]);
  });
  CHECK(std::isinf(memory.stiff_since));
}

TEST_CASE("auto counts anew behind each change of the rates") {
  auto system = curtiss_hirschfelder(1e4);
  AutoStep stepper(system, tight);
  StepMemory memory;
  double t = 0.0;
  const auto steps_until_change = [&](int count) {
    std::vector<double> x(stepper.state(), stepper.state() + 2);
    if (t == 0.0) x.assign(start, start + 2);
    stepper.restart(t, x.data(), memory, true);
    for (int k = 0; k < count; ++k) t = stepper.step(10.0, memory);
  };
  for (int k = 0; k < 100; ++k) steps_until_change(14);
  CHECK(std::isinf(memory.stiff_since));
  steps_until_change(40);
  CHECK(std::isfinite(memory.stiff_since));
}

TEST_CASE("auto goes on with BDF from a checkpoint, and from an event in the step of the finding") {
  auto system = curtiss_hirschfelder(1e4);
  AutoStep first(system, tight);
  StepMemory memory;
  first.restart(0.0, start, memory, true);
  double before = 0.0, t = 0.0;
  while (std::isinf(memory.stiff_since)) {
    before = t;
    t = first.step(10.0, memory);
  }
  CHECK(first.ends_with_rates());  // the step of the finding is still an explicit one
  const double inside = 0.5 * (before + t);
  double x[2];
  first.interpolate(inside, x);
  SECTION("checkpoint") {
    AutoStep second(system, tight);
    second.restart(t, first.state(), memory, true);
    CHECK(memory.stiff_since == t);
    CHECK_FALSE(second.ends_with_rates());
    run(second, 10.0, memory, [](double) {});
    CHECK(second.statistics().steps < 1000);
    CHECK(std::fabs(second.state()[0] - first_state(1e4, 10.0)) < 20.0 * (tight.atol + tight.rtol));
  }
  SECTION("event") {
    const bool changed = GENERATE(true, false);
    first.restart(inside, x, memory, changed);
    CHECK(memory.stiff_since == inside);
    CHECK_FALSE(first.ends_with_rates());
    CHECK(first.state()[0] == x[0]);
    CHECK(first.step(10.0, memory) > inside);
  }
}
