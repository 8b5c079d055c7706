#include "studies/metrics/signal_metrics.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "tests/catch.h"

using namespace flyball;

namespace {

struct Samples {
  std::vector<double> time, value;
  Signal signal() const { return {time, value}; }
};

Samples sampled(const std::function<double(double)>& f, double end, double step) {
  Samples samples;
  const long steps = std::lround(end / step);
  for (long k = 0; k <= steps; ++k) {
    samples.time.push_back(static_cast<double>(k) * step);
    samples.value.push_back(f(samples.time.back()));
  }
  return samples;
}

constexpr double zeta = 0.5, omega = 2.0;

/// Step response of 1/(s^2/omega^2 + 2 zeta s/omega + 1).
double second_order(double t) {
  const double damped = omega * std::sqrt(1.0 - zeta * zeta);
  const double tail = std::cos(damped * t) + zeta / std::sqrt(1.0 - zeta * zeta) * std::sin(damped * t);
  return 1.0 - std::exp(-zeta * omega * t) * tail;
}

constexpr double step = 1e-3;

}  // namespace

TEST_CASE("Metrics: overshoot of a second-order step is exp(-pi zeta/sqrt(1 - zeta^2))") {
  const Samples y = sampled(second_order, 20.0, step);
  const double exact = 100.0 * std::exp(-std::numbers::pi * zeta / std::sqrt(1.0 - zeta * zeta));
  // The peak lies at most step/2 beside a sample: |y''| (step/2)^2/2 < omega^2 step^2/8 = 5e-7 of the way.
  CHECK(overshoot(y.signal(), 0.0, 1.0) == Approx(exact).margin(5e-5));
}

TEST_CASE("Metrics: no overshoot where the end is not passed, none without a way") {
  const Samples y = sampled([](double t) { return 1.0 - std::exp(-t); }, 10.0, step);
  CHECK(overshoot(y.signal(), 0.0, 1.0) == 0.0);
  CHECK(std::isnan(overshoot(y.signal(), 1.0, 1.0)));
}

TEST_CASE("Metrics: a first-order step of time constant T settles in T ln 50 and rises in T ln 9") {
  const double T = 0.7;
  const Samples y = sampled([=](double t) { return 3.0 - 2.0 * std::exp(-t / T); }, 10.0, step);
  // Linear interpolation is wrong by at most (step/T)^2/8 of the slope: step^2/(8 T) = 1.8e-7 s each.
  CHECK(settling_time(y.signal(), 1.0, 3.0) == Approx(T * std::log(50.0)).margin(2e-7));
  CHECK(rise_time(y.signal(), 1.0, 3.0) == Approx(T * std::log(9.0)).margin(4e-7));
}

TEST_CASE("Metrics: settling is the last time outside the band, not the first inside") {
  const Samples y = sampled(second_order, 20.0, step);
  double last = 0.0;
  for (double t = 0.0; t < 20.0; t += 1e-5) {
    if (std::fabs(second_order(t) - 1.0) > 0.02) last = t;
  }
  // The scan is as fine as 1e-5 s.
  CHECK(settling_time(y.signal(), 0.0, 1.0) == Approx(last).margin(1.1e-5));
  CHECK(last > 3.0);
}

TEST_CASE("Metrics: what does not settle or rise within the horizon has no time") {
  const Samples y = sampled(second_order, 1.5, step);
  CHECK(std::isnan(settling_time(y.signal(), 0.0, 1.0)));
  const Samples early = sampled(second_order, 0.5, step);
  CHECK(std::isnan(rise_time(early.signal(), 0.0, 1.0)));
  CHECK(std::isnan(settling_time({}, 0.0, 1.0)));
}

TEST_CASE("Metrics: ISE of a second-order step is zeta/omega + 1/(4 zeta omega)") {
  const Samples y = sampled(second_order, 40.0, step);
  // Trapezoids are wrong by about step^2/12 times the change of (e^2)', which is 0 at both ends: rounding is
  // left. The tail after 40 s is exp(-80).
  CHECK(integral_of_square(y.signal(), 1.0) ==
        Approx(zeta / omega + 1.0 / (4.0 * zeta * omega)).epsilon(1e-9));
}

TEST_CASE("Metrics: IAE of exp(-t) is 1") {
  const Samples y = sampled([](double t) { return -std::exp(-t); }, 40.0, step);
  // step^2/12 times the change of the slope, 1.
  CHECK(integral_of_magnitude(y.signal()) == Approx(1.0).margin(1e-7));
}

TEST_CASE("Metrics: a jump has two values at one time and no area") {
  const std::vector<double> time{0.0, 1.0, 1.0, 3.0}, value{0.0, 0.0, 2.0, 2.0};
  CHECK(integral_of_square({time, value}) == 8.0);
  CHECK(integral_of_magnitude({time, value}, 1.0) == 3.0);
  CHECK(settling_time({time, value}, 0.0, 2.0) == 1.0);
  CHECK(rise_time({time, value}, 0.0, 2.0) == 0.0);
}
