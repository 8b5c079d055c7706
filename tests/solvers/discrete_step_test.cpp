#include "solvers/discrete_step.h"

#include "tests/catch.h"
#include "tests/solvers/problems.h"

using namespace flyball;
using namespace flyball::test;

TEST_CASE("discrete goes to limits, by max_step at most, and evaluates nothing") {
  auto system = make_system(0, [](double, const double*, double*) {});
  DiscreteStep stepper(system, {.max_step = 0.25});
  StepMemory memory;
  stepper.restart(0.0, nullptr, memory, true);
  std::vector<double> ends;
  const auto see = [&](double t) { ends.push_back(t); };
  run(stepper, 0.1, memory, see);
  run(stepper, 0.8, memory, see);
  // 0.7 from 0.1 on: 0.25, and what is left in halves.
  CHECK(ends.size() == 4);
  CHECK(ends[0] == 0.1);
  CHECK(ends[1] == Approx(0.35).epsilon(1e-15));
  CHECK(ends[2] == Approx(0.575).epsilon(1e-15));
  CHECK(ends[3] == 0.8);
  CHECK(system.calls == 0);
  CHECK(stepper.statistics().steps == 4);
}

TEST_CASE("discrete refuses states") {
  auto system = make_system(1, [](double, const double*, double* dx) { dx[0] = 0.0; });
  CHECK_THROWS_AS(DiscreteStep(system, {.max_step = 1.0}), std::invalid_argument);
}
