#include "studies/statistics/sample.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flyball {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Sample::Sample(std::span<const double> numbers) {
  for (const double x : numbers) {
    if (std::isfinite(x)) {
      values.push_back(x);
    } else {
      ++missing;
    }
  }
}

double mean(std::span<const double> values) {
  if (values.empty()) return undefined;
  double sum = 0.0;
  for (const double x : values) sum += x;
  const double first = sum / static_cast<double>(values.size());
  // What rounding left over: a second pass makes the mean of equal values that value.
  double rest = 0.0;
  for (const double x : values) rest += x - first;
  return first + rest / static_cast<double>(values.size());
}

double standard_deviation(std::span<const double> values) {
  if (values.size() < 2) return undefined;
  const double middle = mean(values);
  double squares = 0.0;
  for (const double x : values) squares += (x - middle) * (x - middle);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

double quantile(std::span<const double> values, double p) {
  if (values.empty() || std::isnan(p)) return undefined;
  std::vector<double> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  const double place = std::clamp(p, 0.0, 1.0) * static_cast<double>(sorted.size() - 1);
  const auto k = static_cast<std::size_t>(place);
  if (k + 1 >= sorted.size()) return sorted.back();
  return sorted[k] + (place - std::floor(place)) * (sorted[k + 1] - sorted[k]);
}

}  // namespace flyball
