#include "studies/metrics/signal_metrics.h"

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

/// The first grid point at which the signal is farthest from `initial`.
std::size_t farthest(const Signal& s, double initial) {
  const auto distance = [&](double e) { return std::fabs(e - initial); };
  return static_cast<std::size_t>(std::ranges::max_element(s.value, {}, distance) - s.value.begin());
}

double trapezoids(const Signal& s, auto&& integrand) {
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < s.time.size(); ++k) {
    sum += 0.5 * (s.time[k + 1] - s.time[k]) * (integrand(s.value[k]) + integrand(s.value[k + 1]));
  }
  return sum;
}

double timed_trapezoids(const Signal& s, auto&& integrand) {
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < s.time.size(); ++k) {
    const double before = (s.time[k] - s.time[0]) * integrand(s.value[k]);
    const double after = (s.time[k + 1] - s.time[0]) * integrand(s.value[k + 1]);
    sum += 0.5 * (s.time[k + 1] - s.time[k]) * (before + after);
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

double time_to(const Signal& s, double initial, double final, double level) {
  if (s.value.empty() || initial == final) return undefined;
  return first_time_at(s, initial + level * (final - initial)) - s.time[0];
}

double peak(const Signal& s, double initial) {
  return s.value.empty() ? undefined : s.value[farthest(s, initial)];
}

double peak_time(const Signal& s, double initial) {
  return s.value.empty() ? undefined : s.time[farthest(s, initial)] - s.time[0];
}

double integral(const Signal& s) {
  return trapezoids(s, [](double e) { return e; });
}

double integral_of_square(const Signal& s, double final) {
  return trapezoids(s, [&](double e) { return (e - final) * (e - final); });
}

double integral_of_magnitude(const Signal& s, double final) {
  return trapezoids(s, [&](double e) { return std::fabs(e - final); });
}

double integral_of_time_magnitude(const Signal& s) {
  return timed_trapezoids(s, [](double e) { return std::fabs(e); });
}

double integral_of_time_square(const Signal& s) {
  return timed_trapezoids(s, [](double e) { return e * e; });
}

double mean(const Signal& s) {
  if (s.value.empty()) return undefined;
  const double duration = s.time.back() - s.time.front();
  return duration > 0.0 ? integral(s) / duration : s.value.back();
}

double root_mean_square(const Signal& s) {
  if (s.value.empty()) return undefined;
  const double duration = s.time.back() - s.time.front();
  return duration > 0.0 ? std::sqrt(integral_of_square(s) / duration) : std::fabs(s.value.back());
}

double value_at(const Signal& s, double time) {
  const auto behind = std::ranges::upper_bound(s.time, time) - s.time.begin();
  if (behind == 0) return undefined;
  const auto k = static_cast<std::size_t>(behind) - 1;
  if (s.time[k] == time) return s.value[k];
  if (k + 1 == s.time.size()) return undefined;
  return s.value[k] + (time - s.time[k]) / (s.time[k + 1] - s.time[k]) * (s.value[k + 1] - s.value[k]);
}

double total_variation(const Signal& s) {
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < s.value.size(); ++k) sum += std::fabs(s.value[k + 1] - s.value[k]);
  return sum;
}

double crossings(const Signal& s) {
  int count = 0;
  double side = 0.0;
  for (const double e : s.value) {
    if (e * side < 0.0) ++count;
    if (e != 0.0) side = std::copysign(1.0, e);
  }
  return count;
}

double path_length(const Signal& x, const Signal& y) {
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < x.value.size(); ++k)
    sum += std::hypot(x.value[k + 1] - x.value[k], y.value[k + 1] - y.value[k]);
  return sum;
}

}  // namespace flyball
