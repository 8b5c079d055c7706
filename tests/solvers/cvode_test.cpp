#include "solvers/cvode.h"

#include <cmath>
#include <stdexcept>

#include "tests/catch.h"
#include "tests/solvers/stiff_systems.h"

using namespace flyball;
using namespace flyball::test;

namespace {

/// x_i' = k (x_{i-1} - 2 x_i + x_{i+1}), zero beyond both ends.
auto heat_equation(int n, double k) {
  const auto rates = [n, k](double, const double* x, double* dx) {
    for (int i = 0; i < n; ++i) {
      const double left = i > 0 ? x[i - 1] : 0.0, right = i + 1 < n ? x[i + 1] : 0.0;
      dx[i] = k * (left - 2.0 * x[i] + right);
    }
  };
  const auto jacobian = [n, k](double, const double*, double* values) {
    for (int c = 0; c < n; ++c) {
      for (int r = std::max(c - 1, 0); r <= std::min(c + 1, n - 1); ++r) *values++ = r == c ? -2.0 * k : k;
    }
  };
  return StiffSystem(tridiagonal_pattern(n), rates, jacobian);
}

/// Robertson's kinetics, x1 + x2 + x3 = 1.
auto robertson() {
  const auto rates = [](double, const double* x, double* dx) {
    dx[0] = -0.04 * x[0] + 1e4 * x[1] * x[2];
    dx[2] = 3e7 * x[1] * x[1];
    dx[1] = -dx[0] - dx[2];
  };
  const auto jacobian = [](double, const double* x, double* values) {
    const double columns[] = {-0.04,      0.04,       0.0,         1e4 * x[2], -1e4 * x[2] - 6e7 * x[1],
                              6e7 * x[1], 1e4 * x[1], -1e4 * x[1], 0.0};
    std::copy(std::begin(columns), std::end(columns), values);
  };
  return StiffSystem(dense_pattern(3), rates, jacobian);
}

auto van_der_pol(double mu) {
  const auto rates = [mu](double, const double* x, double* dx) {
    dx[0] = x[1];
    dx[1] = mu * (1.0 - x[0] * x[0]) * x[1] - x[0];
  };
  const auto jacobian = [mu](double, const double* x, double* values) {
    const double columns[] = {0.0, -2.0 * mu * x[0] * x[1] - 1.0, 1.0, mu * (1.0 - x[0] * x[0])};
    std::copy(std::begin(columns), std::end(columns), values);
  };
  return StiffSystem(dense_pattern(2), rates, jacobian);
}

const std::vector<std::string> multistep = {"adams", "bdf"};

}  // namespace

TEST_CASE("CVODE keeps to its tolerance, at steps and inside them") {
  for (const std::string& method : multistep) {
    for (const double tolerance : {1e-5, 1e-8}) {
      INFO(method << " at " << tolerance);
      auto system = harmonic();
      const auto stepper =
          make_stepper(method, system, {.rtol = tolerance, .atol = tolerance, .max_step = 10.0});
      StepMemory memory;
      const double start[] = {1.0, 0.0};
      stepper->restart(0.0, start, memory, true);
      double worst = 0.0, begin = 0.0;
      std::vector<double> x(2);
      run(*stepper, 10.0, memory, [&](double t) {
        worst = std::max(worst, std::fabs(stepper->state()[0] - std::cos(t)));
        const double inside = 0.5 * (begin + t);
        stepper->interpolate(inside, x.data());
        worst = std::max(worst, std::fabs(x[0] - std::cos(inside)));
        begin = t;
      });
      // The error of a step is at most 1 in the norm, so sqrt(2) in one of two states, whose scale is at most
      // 2 tolerances; without damping, the errors of all steps add up.
      CHECK(worst < std::sqrt(2.0) * 2.0 * tolerance * static_cast<double>(stepper->statistics().steps));
      CHECK(stepper->statistics().rate_evaluations == system.calls);
      CHECK(stepper->statistics().steps > 10);
    }
  }
}

TEST_CASE("bdf solves a heat equation through the sparse Jacobian") {
  // The eigenvector sin(pi i / (n + 1)) decays with the rate 4 k sin^2(pi / (2 (n + 1))). The fastest mode, 4
  // k, is sixteen thousand times faster: without an exact Jacobian the steps would be as short as its time.
  const int n = 200;
  const double k = 1e4, tolerance = 1e-7, stop = 0.5;
  auto system = heat_equation(n, k);
  const auto stepper = make_stepper("bdf", system, {.rtol = tolerance, .atol = tolerance, .max_step = stop});
  std::vector<double> x(n);
  for (int i = 0; i < n; ++i) x[i] = std::sin(M_PI * (i + 1) / (n + 1));
  const std::vector<double> start = x;
  StepMemory memory;
  stepper->restart(0.0, x.data(), memory, true);
  run(*stepper, stop, memory, [](double) {});
  const double decay = std::exp(-4.0 * k * std::pow(std::sin(M_PI / (2.0 * (n + 1))), 2) * stop);
  double worst = 0.0;
  for (int i = 0; i < n; ++i) worst = std::max(worst, std::fabs(stepper->state()[i] - decay * start[i]));
  // The errors of about a hundred steps, which the decay damps.
  CHECK(worst < 20.0 * tolerance);
  CHECK(decay > 0.1);
  // Explicit steps are bounded by 2 / (4 k): ten thousand of them.
  CHECK(stepper->statistics().steps < 300);
  CHECK(stepper->statistics().jacobians > 0);
}

TEST_CASE("bdf uses a sparse Jacobian again after restarts") {
  const int n = 100;
  auto system = heat_equation(n, 1.0);
  const auto stepper = make_stepper("bdf", system, {.rtol = 1e-7, .atol = 1e-7, .max_step = 10.0});
  std::vector<double> x(n, 0.0);
  StepMemory memory;
  double sum = 0.0;
  for (int k = 0; k < 5; ++k) {
    // Heat that enters in the middle stays on the line as long as nothing reaches its ends.
    x[n / 2] += 1.0;
    sum += 1.0;
    stepper->restart(k, x.data(), memory, true);
    run(*stepper, k + 1.0, memory, [](double) {});
    x.assign(stepper->state(), stepper->state() + n);
    double now = 0.0;
    for (const double value : x) now += value;
    // Each method here keeps linear invariants up to the tolerance of its Newton iteration, for each of n
    // states.
    CHECK(now == Approx(sum).margin(n * 1e-7));
  }
  CHECK(stepper->statistics().restarts == 5);
}

TEST_CASE("bdf reproduces the reference values of Robertson's problem") {
  auto system = robertson();
  const auto stepper = make_stepper("bdf", system, {.rtol = 1e-8, .atol = 1e-13, .max_step = 100.0});
  const double start[] = {1.0, 0.0, 0.0};
  StepMemory memory;
  stepper->restart(0.0, start, memory, true);
  run(*stepper, 0.4, memory, [](double) {});
  // The five digits of the documentation of SUNDIALS' example cvRoberts_dns, within half a unit of the last.
  CHECK(stepper->state()[0] == Approx(9.8517e-01).epsilon(0).margin(0.5e-05));
  CHECK(stepper->state()[1] == Approx(3.3864e-05).epsilon(0).margin(0.5e-09));
  CHECK(stepper->state()[2] == Approx(1.4794e-02).epsilon(0).margin(0.5e-06));
  run(*stepper, 40.0, memory, [](double) {});
  // W. H. Enright, J. D. Pryce, ACM Trans. Math. Softw. 13 (1987) 1-27, problem D2 in its unscaled form. The
  // problem damps errors: those of at most a hundred steps, each of the relative tolerance, are left.
  CHECK(stepper->state()[0] == Approx(0.7158270687193941).epsilon(1e-6));
  CHECK(stepper->state()[1] == Approx(9.185534764557338e-06).epsilon(1e-6));
  CHECK(stepper->state()[2] == Approx(0.2841637457458413).epsilon(1e-6));
}

TEST_CASE("bdf finishes van der Pol's oscillator at mu = 1000") {
  const double mu = 1000.0;
  auto system = van_der_pol(mu);
  const auto stepper = make_stepper("bdf", system, {.rtol = 1e-6, .atol = 1e-8, .max_step = 2000.0});
  const double start[] = {2.0, 0.0};
  StepMemory memory;
  stepper->restart(0.0, start, memory, true);
  std::vector<double> crossings;
  double t_before = 0.0, x_before = 2.0;
  run(*stepper, 3000.0, memory, [&](double t) {
    const double x = stepper->state()[0];
    if (x * x_before < 0.0) crossings.push_back(0.5 * (t + t_before));
    t_before = t;
    x_before = x;
  });
  // Three quarters of a period of relaxation: T = (3 - 2 ln 2) mu + 7.01432 mu^(-1/3) + O(ln(mu) / mu) (A. A.
  // Dorodnitsyn, 1947), so that x crosses zero every 807.5 s.
  const double period = (3.0 - 2.0 * std::log(2.0)) * mu + 7.01432 * std::pow(mu, -1.0 / 3.0);
  REQUIRE(crossings.size() == 3);
  // 1 s: the next term of the series is below 0.01 s, the jump between the two ends of a step is shorter than
  // that.
  CHECK(crossings[2] - crossings[0] == Approx(period).margin(1.0));
  CHECK(stepper->statistics().steps < 5000);
}

TEST_CASE("CVODE lands on limits exactly") {
  for (const std::string& method : multistep) {
    INFO(method);
    auto system = harmonic();
    const auto stepper = make_stepper(method, system, {.rtol = 1e-8, .atol = 1e-8, .max_step = 10.0});
    const double start[] = {1.0, 0.0};
    StepMemory memory;
    stepper->restart(0.0, start, memory, true);
    for (int k = 1; k <= 30; ++k) {
      const double limit = k / 3.0;
      double t = 0.0;
      do {
        t = stepper->step(limit, memory);
        REQUIRE(t <= limit);
      } while (t < limit);
      CHECK(std::fabs(stepper->state()[0] - std::cos(limit)) <
            1e-5);  // a thousand tolerances: no step is missing
    }
  }
}

TEST_CASE("CVODE steps to a limit that is only rounding away") {
  for (const std::string& method : multistep) {
    auto system = harmonic();
    const auto stepper = make_stepper(method, system, {.max_step = 10.0});
    const double start[] = {0.0, 1.0};
    StepMemory memory;
    stepper->restart(1.0, start, memory, true);
    const double limit = std::nextafter(1.0, 2.0);
    CHECK(stepper->step(limit, memory) == limit);
    CHECK(stepper->state()[0] == Approx(limit - 1.0));
    run(*stepper, 2.0, memory, [](double) {});
    CHECK(stepper->state()[0] == Approx(std::sin(1.0)).epsilon(1e-4));  // a hundred times rtol
  }
}

TEST_CASE("CVODE keeps its history when nothing changed") {
  for (const std::string& method : multistep) {
    INFO(method);
    auto plain = harmonic(), interrupted = harmonic();
    const StepperOptions options{.rtol = 1e-8, .atol = 1e-8, .max_step = 10.0};
    const auto reference = make_stepper(method, plain, options);
    const auto stepper = make_stepper(method, interrupted, options);
    const double start[] = {1.0, 0.0};
    StepMemory memory, reference_memory;
    reference->restart(0.0, start, reference_memory, true);
    stepper->restart(0.0, start, memory, true);
    double before = 0.0;
    std::vector<double> x(2);
    run(*reference, 10.0, reference_memory, [&](double t) {
      REQUIRE(stepper->step(10.0, memory) == t);
      REQUIRE(stepper->state()[0] == reference->state()[0]);
      // An event inside the step, after which everything is as it was: the rest of the step is handed out.
      const double inside = 0.5 * (before + t);
      stepper->interpolate(inside, x.data());
      stepper->restart(inside, x.data(), memory, false);
      REQUIRE(stepper->step(10.0, memory) == t);
      REQUIRE(stepper->state()[0] == reference->state()[0]);
      stepper->restart(t, stepper->state(), memory, false);
      before = t;
    });
    CHECK(interrupted.calls == plain.calls);
    CHECK(stepper->statistics().steps == reference->statistics().steps);
  }
}

TEST_CASE("CVODE stops before the end of its step when a new limit asks for it") {
  for (const std::string& method : multistep) {
    INFO(method);
    auto system = harmonic();
    const auto stepper = make_stepper(method, system, {.rtol = 1e-8, .atol = 1e-8, .max_step = 10.0});
    const double start[] = {1.0, 0.0};
    StepMemory memory;
    stepper->restart(0.0, start, memory, true);
    double begin = 0.0, end = 0.0;
    while (end < 2.0) {
      begin = end;
      end = stepper->step(10.0, memory);
    }
    std::vector<double> x(2);
    const double event = begin + 0.25 * (end - begin), limit = begin + 0.75 * (end - begin);
    stepper->interpolate(event, x.data());
    stepper->restart(event, x.data(), memory, false);
    double t = 0.0;
    run(*stepper, limit, memory, [&](double now) { t = now; });
    CHECK(t == limit);
    CHECK(std::fabs(stepper->state()[0] - std::cos(limit)) < 1e-6);  // a hundred tolerances
  }
}

TEST_CASE("CVODE hands the size of a first step to the next restart") {
  for (const std::string& method : multistep) {
    INFO(method);
    auto system = harmonic();
    const auto stepper = make_stepper(method, system, {.rtol = 1e-6, .atol = 1e-6, .max_step = 10.0});
    const double start[] = {1.0, 0.0};
    StepMemory memory;
    stepper->restart(0.0, start, memory, true);
    stepper->step(10.0, memory);
    const double size = memory.size;
    REQUIRE(size > 0.0);
    run(*stepper, 10.0, memory, [](double) {});
    CHECK(memory.size == size);
    stepper->restart(0.0, start, memory, true);
    const long calls = system.calls;
    CHECK(stepper->step(10.0, memory) == Approx(size).epsilon(1e-12));
    // The rates at the start and one or two corrections: no trial evaluations to choose a step.
    CHECK(system.calls - calls <= 4);
  }
}

TEST_CASE("CVODE comes down from a remembered step that a jump made far too long") {
  for (const std::string& method : multistep) {
    INFO(method);
    const double k = 1e4, tolerance = 1e-10;
    const auto rates = [=](double, const double* x, double* dx) { dx[0] = k * (1.0 - x[0]); };
    const auto jacobian = [=](double, const double*, double* values) { values[0] = -k; };
    StiffSystem system(dense_pattern(1), rates, jacobian);
    const auto stepper =
        make_stepper(method, system, {.rtol = tolerance, .atol = tolerance, .max_step = 1.0});
    // As rest leaves it. The error of a first step h is (k h)^2 / 2, so h must fall to about 1e-9 s.
    StepMemory memory;
    memory.size = 1.0;
    const double start = 0.0, stop = 2.0 / k;
    stepper->restart(0.0, &start, memory, true);
    double t = 0.0;
    do {
      t = stepper->step(1.0, memory);
    } while (t < stop);
    // As above: the errors of all steps add up, each at most twice the tolerance.
    const double steps = static_cast<double>(stepper->statistics().steps);
    CHECK(std::fabs(stepper->state()[0] + std::expm1(-k * t)) < 2.0 * tolerance * steps);
    CHECK(stepper->statistics().rejected > 0);
  }
}

TEST_CASE("CVODE without states steps by max_step") {
  for (const std::string& method : multistep) {
    StiffSystem system(
        Sparsity{0, {0}, {}}, [](double, const double*, double*) {}, [](double, const double*, double*) {});
    const auto stepper = make_stepper(method, system, {.max_step = 0.25});
    const double none = 0.0;
    StepMemory memory;
    stepper->restart(0.0, &none, memory, true);
    std::vector<double> ends;
    run(*stepper, 1.0, memory, [&](double t) { ends.push_back(t); });
    CHECK(ends == std::vector<double>{0.25, 0.5, 0.75, 1.0});
  }
}

TEST_CASE("Methods are made by name") {
  auto system = harmonic();
  auto idle = make_system(0, [](double, const double*, double*) {});
  for (const std::string& method : stepper_methods()) {
    System<double>& fitting = method == "discrete" ? static_cast<System<double>&>(idle) : system;
    CHECK(make_stepper(method, fitting, {.max_step = 1.0, .fixed_step = 0.1}) != nullptr);
  }
  CHECK_THROWS_AS(make_stepper("ode45", system, {.max_step = 1.0}), std::invalid_argument);
  CHECK_THROWS_AS(make_stepper("dp5", system, {}), std::invalid_argument);
  CHECK_THROWS_AS(make_stepper("rk4", system, {.max_step = 1.0}), std::invalid_argument);
}
