// How CVODE's steppers fail: exceptions of the system, and steps that vanish.
#include <cmath>
#include <stdexcept>

#include "solvers/errors.h"
#include "tests/catch.h"
#include "tests/solvers/stiff_systems.h"

using namespace flyball;
using namespace flyball::test;

namespace {

/// x1' = x1^2 has its pole at 1 s when x1 starts at 1; x2 follows it at a millionth.
auto pole() {
  const auto rates = [](double, const double* x, double* dx) {
    dx[0] = x[0] * x[0];
    dx[1] = 1e-6 * dx[0];
  };
  const auto jacobian = [](double, const double* x, double* values) {
    const double columns[] = {2.0 * x[0], 2e-6 * x[0], 0.0, 0.0};
    std::copy(std::begin(columns), std::end(columns), values);
  };
  return StiffSystem(dense_pattern(2), rates, jacobian);
}

const std::vector<std::string> multistep = {"adams", "bdf"};

}  // namespace

TEST_CASE("Exceptions of the system pass through CVODE") {
  for (const std::string& method : multistep) {
    INFO(method);
    bool armed = true;
    const auto rates = [&](double t, const double* x, double* dx) {
      if (armed && t > 0.5)
        throw SimulationError(SimulationError::Kind::not_finite, t, "plant.y is not finite");
      dx[0] = -x[0];
    };
    const auto jacobian = [](double, const double*, double* values) { values[0] = -1.0; };
    StiffSystem system(dense_pattern(1), rates, jacobian);
    const auto stepper = make_stepper(method, system, {.max_step = 0.1});
    const double start = 1.0;
    StepMemory memory;
    stepper->restart(0.0, &start, memory, true);
    try {
      run(*stepper, 1.0, memory, [](double) {});
      FAIL("the exception was lost");
    } catch (const SimulationError& error) {
      CHECK(error.kind() == SimulationError::Kind::not_finite);
      CHECK(std::string(error.what()) == "plant.y is not finite");
    }
    // The stepper is usable again, also when nothing changed.
    armed = false;
    stepper->restart(0.0, &start, memory, false);
    run(*stepper, 1.0, memory, [](double) {});
    CHECK(stepper->state()[0] == Approx(std::exp(-1.0)).epsilon(1e-4));  // a hundred times rtol
  }
}

TEST_CASE("Exceptions of the Jacobian pass through CVODE") {
  const auto rates = [](double, const double* x, double* dx) { dx[0] = -x[0]; };
  const auto jacobian = [](double, const double*, double*) { throw std::domain_error("no derivative"); };
  StiffSystem system(dense_pattern(1), rates, jacobian);
  const auto stepper = make_stepper("bdf", system, {.max_step = 0.1});
  const double start = 1.0;
  StepMemory memory;
  stepper->restart(0.0, &start, memory, true);
  CHECK_THROWS_AS(stepper->step(1.0, memory), std::domain_error);
}

TEST_CASE("CVODE names the states that make the step vanish") {
  for (const std::string& method : multistep) {
    INFO(method);
    auto system = pole();
    const auto stepper = make_stepper(method, system, {.rtol = 1e-6, .atol = 1e-8, .max_step = 0.1});
    const double start[] = {1.0, 0.0};
    StepMemory memory;
    stepper->restart(0.0, start, memory, true);
    try {
      run(*stepper, 2.0, memory, [](double) {});
      FAIL("the pole was passed");
    } catch (const SimulationError& error) {
      const std::string message = error.what();
      INFO(message);
      CHECK(error.kind() == SimulationError::Kind::step_vanished);
      // Errors before the pole move it; each of some hundred steps by about the tolerance.
      CHECK(error.time() == Approx(1.0).epsilon(1e-3));
      CHECK(message.find("the step vanished") == 0);
      CHECK(message.find("plant.x1: error ") != std::string::npos);
      CHECK(message.find(" times the tolerance") != std::string::npos);
    }
  }
}
