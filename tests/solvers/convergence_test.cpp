#include <algorithm>
#include <cmath>

#include "solvers/stepper.h"
#include "tests/catch.h"
#include "tests/solvers/problems.h"

using namespace flyball;
using namespace flyball::test;

namespace {

// Tolerances so loose that the step size alone decides.
StepperOptions steps_of(double size) {
  return {.rtol = 1e6, .atol = 1e6, .max_step = size, .fixed_step = size};
}

/// The greatest error at the ends of the steps.
double error_at_ends(const std::string& method, const Problem& problem, double size) {
  auto system = make_system(static_cast<int>(problem.start.size()), problem.rates);
  const auto stepper = make_stepper(method, system, steps_of(size));
  StepMemory memory{.size = size};
  stepper->restart(problem.begin, problem.start.data(), memory, true);
  double worst = 0.0;
  run(*stepper, problem.stop, memory,
      [&](double t) { worst = std::max(worst, std::fabs(stepper->state()[0] - problem.first_state(t))); });
  return worst;
}

/// The greatest error of the continuous extension inside the first step, which starts on the solution.
double error_inside(const std::string& method, const Problem& problem, double size) {
  auto system = make_system(static_cast<int>(problem.start.size()), problem.rates);
  const auto stepper = make_stepper(method, system, steps_of(size));
  StepMemory memory{.size = size};
  stepper->restart(problem.begin, problem.start.data(), memory, true);
  const double end = stepper->step(problem.stop, memory);
  double worst = 0.0;
  std::vector<double> x(problem.start.size());
  for (const double theta : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    const double t = problem.begin + theta * (end - problem.begin);
    stepper->interpolate(t, x.data());
    worst = std::max(worst, std::fabs(x[0] - problem.first_state(t)));
  }
  return worst;
}

/// The slope of log(error) over log(step) for `counts` steps from begin to stop.
template <class Error>
double fitted_slope(const Problem& problem, const std::vector<int>& counts, Error&& error) {
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (const int count : counts) {
    const double size = (problem.stop - problem.begin) / count;
    const double x = std::log(size), y = std::log(error(size));
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const auto n = static_cast<double>(counts.size());
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

struct Case {
  std::string method;
  int order;            // at the ends of steps
  int extension_order;  // inside: the error over one step is of one order more
  std::vector<int> counts;
};

// Counts of steps that make the leading term dominate and keep the error two decades above rounding.
const std::vector<Case> cases = {
    {"euler", 1, 1, {400, 800, 1600, 3200}},
    {"heun", 2, 2, {400, 800, 1600, 3200}},
    {"rk4", 4, 3, {40, 80, 160, 320}},
    {"dp5", 5, 4, {80, 120, 160, 240}},
};

}  // namespace

TEST_CASE("Methods converge with their order") {
  for (const Problem& problem : {logistic(), oscillator(), bell()}) {
    for (const Case& c : cases) {
      INFO(c.method << " on " << problem.name);
      const double order = fitted_slope(problem, c.counts,
                                        [&](double size) { return error_at_ends(c.method, problem, size); });
      // A method whose coefficients are wrong loses at least one whole order.
      CHECK(std::fabs(order - c.order) < 0.1);
    }
  }
}

TEST_CASE("Continuous extensions converge with their order") {
  for (const Problem& problem : {logistic(), oscillator(), bell()}) {
    for (const Case& c : cases) {
      INFO(c.method << " on " << problem.name);
      const double slope =
          fitted_slope(problem, c.counts, [&](double size) { return error_inside(c.method, problem, size); });
      CHECK(std::fabs(slope - (c.extension_order + 1)) < 0.1);
    }
  }
}
