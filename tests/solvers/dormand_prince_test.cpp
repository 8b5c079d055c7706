#include "solvers/dormand_prince.h"

#include <cmath>
#include <limits>

#include "blocks/jet.h"
#include "solvers/errors.h"
#include "tests/catch.h"
#include "tests/solvers/problems.h"

using namespace flyball;
using namespace flyball::test;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

StepperOptions tolerances(double rtol, double atol, double max_step = infinity) {
  return {.rtol = rtol, .atol = atol, .max_step = max_step};
}

}  // namespace

TEST_CASE("dp5 keeps to its tolerance") {
  for (const Problem& problem : {logistic(), oscillator(), bell()}) {
    for (const double tolerance : {1e-4, 1e-7, 1e-10}) {
      INFO(problem.name << " at " << tolerance);
      auto system = make_system(static_cast<int>(problem.start.size()), problem.rates);
      DormandPrince<double> stepper(system, tolerances(tolerance, tolerance));
      StepMemory memory;
      stepper.restart(problem.begin, problem.start.data(), memory, true);
      double worst = 0.0;
      run(stepper, problem.stop, memory, [&](double t) {
        const double exact = problem.first_state(t);
        worst =
            std::max(worst, std::fabs(stepper.state()[0] - exact) / (tolerance * (1.0 + std::fabs(exact))));
      });
      // Each of some ten steps may add one tolerance, and these problems do not amplify errors by more than
      // e.
      CHECK(worst < 20.0);
      // The step is as large as the tolerance allows, not smaller by decades.
      CHECK(worst > 1e-3);
      CHECK(stepper.statistics().rate_evaluations == system.calls);
    }
  }
}

TEST_CASE("dp5 differentiates through its steps") {
  // x' = p x (1 - x), x(0) = q: dx/dp = t x (1 - x), dx/dq = x (1 - x) / (q (1 - q)).
  const double p_value = 1.3, q_value = 0.2, stop = 3.0, tolerance = 1e-10;
  const Jet p(p_value, 0), q(q_value, 1);
  auto system = make_system<Jet>(1, [&](Jet, const Jet* x, Jet* dx) { dx[0] = p * x[0] * (1.0 - x[0]); });
  DormandPrince<Jet> stepper(system, tolerances(tolerance, tolerance));
  StepMemory memory;
  stepper.restart(Jet(0.0), &q, memory, true);
  run(stepper, Jet(stop, 2), memory, [](const Jet&) {});

  const Jet x = stepper.state()[0];
  const double exact = 1.0 / (1.0 + (1.0 / q_value - 1.0) * std::exp(-p_value * stop));
  // The steps are chosen by values alone: the error of a derivative is that of the value times its condition,
  // here below 10, and about a hundred steps add up.
  const double allowed = 1e3 * tolerance;
  CHECK(std::fabs(x.a - exact) < allowed);
  CHECK(std::fabs(x.v[0] - stop * exact * (1.0 - exact)) < allowed);
  CHECK(std::fabs(x.v[1] - exact * (1.0 - exact) / (q_value * (1.0 - q_value))) < allowed);
  // The last step lands on a time that is itself differentiated: dx/dstop is the rate.
  CHECK(std::fabs(x.v[2] - p_value * exact * (1.0 - exact)) < allowed);
}

TEST_CASE("dp5 takes the same steps on Jets as on numbers") {
  const auto rates = [](auto, const auto* x, auto* dx) {
    dx[0] = x[1];
    dx[1] = (1.0 - x[0] * x[0]) * x[1] - x[0];
  };
  auto numbers = make_system<double>(2, rates);
  auto jets = make_system<Jet>(2, rates);
  DormandPrince<double> on_numbers(numbers, tolerances(1e-6, 1e-8));
  DormandPrince<Jet> on_jets(jets, tolerances(1e-6, 1e-8));
  const double x[] = {2.0, 0.0};
  const Jet start[] = {Jet(2.0, 0), Jet(0.0, 1)};
  StepMemory memory, jet_memory;
  on_numbers.restart(0.0, x, memory, true);
  on_jets.restart(Jet(0.0), start, jet_memory, true);
  run(on_numbers, 10.0, memory, [&](double t) {
    REQUIRE(on_jets.step(Jet(10.0), jet_memory).a == t);
    REQUIRE(on_jets.state()[0].a == on_numbers.state()[0]);
  });
  CHECK(on_numbers.statistics().steps > 10);
}

TEST_CASE("dp5 keeps its step size across restarts and short steps") {
  const Problem problem = oscillator();
  auto system = make_system(2, problem.rates);
  DormandPrince<double> stepper(system, tolerances(1e-6, 1e-6));
  StepMemory memory;
  stepper.restart(0.0, problem.start.data(), memory, true);
  double t = 0.0;
  for (int i = 0; i < 8; ++i) t = stepper.step(infinity, memory);
  const double size = memory.size;
  REQUIRE(size > 0.05);

  SECTION("a restart tries the remembered size") {
    stepper.restart(t, std::vector<double>(stepper.state(), stepper.state() + 2).data(), memory, true);
    CHECK(memory.size == size);
    // The end of a step is rounded to the last place of t.
    CHECK(stepper.step(infinity, memory) - t == Approx(size).epsilon(1e-14));
  }
  SECTION("a limit does not shrink it") {
    for (int i = 1; i <= 20; ++i) {
      const double limit = t + 1e-3 * i;
      CHECK(stepper.step(limit, memory) == limit);
      CHECK(memory.size >= size);
    }
  }
  SECTION("no rates are evaluated again when nothing changed") {
    const long calls = system.calls;
    stepper.restart(t, stepper.state(), memory, false);
    CHECK(system.calls == calls);
    stepper.restart(t, std::vector<double>(stepper.state(), stepper.state() + 2).data(), memory, true);
    CHECK(system.calls == calls + 1);
  }
}

TEST_CASE("dp5 lands on limits and leaves no tiny rest") {
  auto system = make_system(1, [](double, const double*, double* dx) { dx[0] = 1.0; });
  DormandPrince<double> stepper(system, tolerances(1e-6, 1e-6, 0.1));
  const double x = 0.0;
  const auto ends = [&](double size, double limit) {
    StepMemory memory{.size = size};
    stepper.restart(0.0, &x, memory, true);
    std::vector<double> all;
    run(stepper, limit, memory, [&](double t) {
      all.push_back(t);
      CHECK(system.last_time == t);
    });
    return all;
  };
  CHECK(ends(0.05, 0.0505) == std::vector<double>{0.0505});          // 1 % further: stretched
  CHECK(ends(0.1, 0.1005) == std::vector<double>{0.05025, 0.1005});  // not beyond max_step: halved
  CHECK(ends(0.05, 0.08) == std::vector<double>{0.04, 0.08});
  // Sums of 0.1 miss 1 by rounding; the last step ends on it all the same.
  const std::vector<double> tenths = ends(0.1, 1.0);
  CHECK(tenths.size() == 10);
  CHECK(tenths.back() == 1.0);
}

TEST_CASE("dp5 respects max_step") {
  auto system = make_system(1, [](double, const double*, double* dx) { dx[0] = 1.0; });
  DormandPrince<double> stepper(system, tolerances(1e-3, 1e-3, 0.3));
  StepMemory memory;
  const double x = 0.0;
  stepper.restart(0.0, &x, memory, true);
  double begin = 0.0, longest = 0.0;
  run(stepper, 10.0, memory, [&](double t) {
    longest = std::max(longest, t - begin);
    begin = t;
  });
  // 1e-10: what the last step may stretch; the steps themselves reach max_step.
  CHECK(longest <= 0.3 * (1.0 + 1e-10));
  CHECK(longest >= 0.299);
}

TEST_CASE("dp5 ends with the rates at the end of the step, also after a rejection") {
  // From rest into a pulse that is a hundred times faster than the remembered step.
  auto system = make_system(1, [](double t, const double* x, double* dx) {
    dx[0] = -x[0] + 100.0 * std::exp(-1e4 * (t - 0.5) * (t - 0.5));
  });
  DormandPrince<double> stepper(system, tolerances(1e-6, 1e-6));
  StepMemory memory{.size = 0.5};
  const double x = 0.0;
  stepper.restart(0.0, &x, memory, true);
  run(stepper, 2.0, memory, [&](double t) { REQUIRE(system.last_time == t); });
  CHECK(stepper.statistics().rejected > 0);
  CHECK(stepper.statistics().rate_evaluations == system.calls);
}

TEST_CASE("dp5 names the states that make the step vanish") {
  // x1' = x1^2 from 1 has its pole at 1 s; x2 is at rest, x3 follows x1 at a thousandth.
  auto system = make_system(3, [](double, const double* x, double* dx) {
    dx[0] = x[0] * x[0];
    dx[1] = 0.0;
    dx[2] = 1e-3 * dx[0];
  });
  DormandPrince<double> stepper(system, tolerances(1e-6, 1e-8));
  StepMemory memory;
  const double start[] = {1.0, 1.0, 0.0};
  stepper.restart(0.0, start, memory, true);
  try {
    run(stepper, 2.0, memory, [](double) {});
    FAIL("the pole was passed");
  } catch (const SimulationError& error) {
    const std::string message = error.what();
    INFO(message);
    CHECK(error.kind() == SimulationError::Kind::step_vanished);
    // The steps shrink with the distance from the pole; the error that they add moves it by about the
    // tolerance.
    CHECK(error.time() == Approx(1.0).epsilon(1e-5));
    CHECK(message.find("the step vanished: at t = 1.00000") == 0);
    CHECK(message.find("plant.x1: error ") != std::string::npos);
    CHECK(message.find(" times the tolerance") != std::string::npos);
    CHECK(message.find("plant.x1") < message.find("plant.x2"));
    CHECK(message.find("plant.x3") < message.find("plant.x2"));
  }
}

TEST_CASE("dp5 without states steps by max_step and evaluates the outputs") {
  auto system = make_system(0, [](double, const double*, double*) {});
  DormandPrince<double> stepper(system, tolerances(1e-6, 1e-6, 0.25));
  StepMemory memory;
  const double none = 0.0;
  stepper.restart(0.0, &none, memory, true);
  std::vector<double> ends;
  run(stepper, 1.0, memory, [&](double t) {
    ends.push_back(t);
    CHECK(system.last_time == t);
  });
  CHECK(ends == std::vector<double>{0.25, 0.5, 0.75, 1.0});
  CHECK(stepper.statistics().steps == 4);
}

TEST_CASE("dp5's extension joins the ends of the step exactly") {
  // An event at the end of a step must not be seen on the other side by rounding.
  auto system = make_system(1, [](double, const double* x, double* dx) { dx[0] = x[0]; });
  DormandPrince<double> stepper(system, tolerances(1e6, 1e6, 2.0));
  for (int k = 0; k < 20; ++k) {
    StepMemory memory{.size = 2.0};
    const double start = std::exp(0.1 * k);
    stepper.restart(0.0, &start, memory, true);
    const double end = stepper.step(10.0, memory);
    double x = 0.0;
    stepper.interpolate(0.0, &x);
    CHECK(x == start);
    stepper.interpolate(end, &x);
    CHECK(x == stepper.state()[0]);
  }
}
