#include "studies/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flyball {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

/// The time between grid points k and k + 1 at which the straight line is at `level`.
double time_at(const Signal& s, std::size_t k, double level) {
  const double part = (level - s.value[k]) / (s.value[k + 1] - s.value[k]);
  return s.time[k] + part * (s.time[k + 1] - s.time[k]);
}

/// The first time at which the signal reaches `level`, coming from the side of its first value.
double first_time_at(const Signal& s, double level) {
  if (s.value.empty()) return undefined;
  const bool from_below = s.value[0] < level;
  for (std::size_t k = 0; k < s.value.size(); ++k) {
    const bool reached = from_below ? s.value[k] >= level : s.value[k] <= level;
    if (reached) return k == 0 ? s.time[0] : time_at(s, k - 1, level);
  }
  return undefined;
}

double trapezoids(const Signal& s, auto&& integrand) {
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < s.time.size(); ++k) {
    sum += 0.5 * (s.time[k + 1] - s.time[k]) * (integrand(s.value[k]) + integrand(s.value[k + 1]));
  }
  return sum;
}

}  // namespace

double overshoot(const Signal& s, double initial, double final) {
  if (s.value.empty() || initial == final) return undefined;
  double beyond = 0.0;
  for (const double e : s.value) beyond = std::max(beyond, (e - final) / (final - initial));
  return 100.0 * beyond;
}

double settling_time(const Signal& s, double initial, double final, double band) {
  if (s.value.empty() || initial == final) return undefined;
  const double width = band * std::fabs(final - initial);
  const auto outside = [&](double e) { return std::fabs(e - final) > width; };
  std::size_t inside_from = s.value.size();
  while (inside_from > 0 && !outside(s.value[inside_from - 1])) --inside_from;
  if (inside_from == s.value.size()) return undefined;
  if (inside_from == 0) return 0.0;
  const std::size_t last_outside = inside_from - 1;
  const double edge = final + std::copysign(width, s.value[last_outside] - final);
  return time_at(s, last_outside, edge) - s.time[0];
}

double rise_time(const Signal& s, double initial, double final) {
  if (initial == final) return undefined;
  return first_time_at(s, initial + 0.9 * (final - initial)) -
         first_time_at(s, initial + 0.1 * (final - initial));
}

double integral_of_square(const Signal& s, double final) {
  return trapezoids(s, [&](double e) { return (e - final) * (e - final); });
}

double integral_of_magnitude(const Signal& s, double final) {
  return trapezoids(s, [&](double e) { return std::fabs(e - final); });
}

}  // namespace flyball
