#include "tools/arc_loop.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "solvers/workspace.h"
#include "studies/metrics/signal_metrics.h"

namespace flyball {
namespace {

constexpr double band = 0.02;

/// The last time before `end` at which |H| of the linearised loop leaves the band: bracketed on a grid that
/// is fine against every period and time constant, then bisected.
double linear_settling(const ArcLoop& loop, double end) {
  const auto outside = [&](double t) { return std::fabs(linear_distance(loop, t)) > band * loop.H0; };
  const double step = 1e-3;
  double inside = end;
  while (inside > 0.0 && !outside(inside)) inside -= step;
  double low = inside, high = inside + step;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (outside(middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

ArcLoop arc_loop_of(const Plan& plan) {
  Workspace<double> workspace(plan);
  initialise(plan, workspace);
  const auto value = [&](const char* name) {
    const int slot = plan.parameter_slot(name);
    if (slot < 0) throw std::runtime_error(std::string("the model has no parameter ") + name);
    return workspace.values[static_cast<std::size_t>(slot)];
  };
  return {value("V"), value("L"), value("K_H"), value("K_gamma"), value("H.initial")};
}

double linear_distance(const ArcLoop& loop, double t) {
  const double a = loop.a();
  const double discriminant = 0.25 * a * a - loop.b();
  const double decay = std::exp(-0.5 * a * t);
  // At the critical gain rounding decides the sign; there sin(w t)/w and sinh(r t)/r both are t.
  const double rate = std::sqrt(std::fabs(discriminant));
  if (rate * t < 1e-6) return loop.H0 * (1.0 + 0.5 * a * t) * decay;
  if (discriminant < 0.0) {
    return loop.H0 * decay * (std::cos(rate * t) + 0.5 * a / rate * std::sin(rate * t));
  }
  const double slow = std::exp((rate - 0.5 * a) * t), fast = std::exp((-rate - 0.5 * a) * t);
  return 0.5 * loop.H0 * ((1.0 + 0.5 * a / rate) * slow + (1.0 - 0.5 * a / rate) * fast);
}

ArcMeasures linear_response(const ArcLoop& loop) {
  const double a = loop.a(), b = loop.b();
  ArcMeasures result;
  result.damping = loop.K_gamma / std::sqrt(2.0 * loop.K_H * loop.L);
  const double z = result.damping;
  result.overshoot = z < 1.0 ? 100.0 * std::exp(-std::numbers::pi * z / std::sqrt(1.0 - z * z)) : 0.0;
  result.settling = linear_settling(loop, arc_horizon);
  result.ise = loop.H0 * loop.H0 * (a / (2.0 * b) + 1.0 / (2.0 * a));
  return result;
}

ArcMeasures measure(const Log& log) {
  const auto column = std::ranges::find(log.columns(), "H", &LogColumn::name);
  if (column == log.columns().end()) throw std::runtime_error("the model does not log H");
  std::vector<double> time, distance;
  for (std::int64_t row = 0; row < log.rows(); ++row) {
    time.push_back(log.time(row));
    distance.push_back(log.value(row, static_cast<int>(column - log.columns().begin())));
  }
  const Signal signal{time, distance};
  const double start = distance.at(0);
  return {0.0, overshoot(signal, start, 0.0), settling_time(signal, start, 0.0, band),
          integral_of_square(signal)};
}

}  // namespace flyball
