#include "studies/statistics/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "blocks/random.h"
#include "studies/language/sampling.h"
#include "studies/statistics/sample.h"

namespace flyball {
namespace {

using Statistic = double (*)(std::span<const double>);

/// The statistic of samples drawn from the values, with replacement, in order of size.
std::vector<double> resampled(std::span<const double> values, Statistic statistic,
                              const BootstrapOptions& options) {
  const double stream = random_stream(options.seed, "bootstrap");
  const auto n = static_cast<double>(values.size());
  std::vector<double> drawn(values.size()), result;
  double k = 0.0;
  for (int resample = 0; resample < options.resamples; ++resample) {
    for (double& x : drawn) x = values[static_cast<std::size_t>(uniform_number(stream, k++) * n)];
    result.push_back(statistic(drawn));
  }
  std::ranges::sort(result);
  return result;
}

/// How fast the standard error changes with the value, from the statistic without one value at a time.
double acceleration(std::span<const double> values, Statistic statistic) {
  std::vector<double> without;
  std::vector<double> rest(values.begin() + 1, values.end());
  for (std::size_t k = 0; k < values.size(); ++k) {
    without.push_back(statistic(rest));
    if (k < rest.size()) rest[k] = values[k];
  }
  const double middle = mean(without);
  double squares = 0.0, cubes = 0.0;
  for (const double x : without) {
    squares += (middle - x) * (middle - x);
    cubes += (middle - x) * (middle - x) * (middle - x);
  }
  return squares > 0.0 ? cubes / (6.0 * std::pow(squares, 1.5)) : 0.0;
}

/// The part of the sorted values below x; of those equal to it, half.
double part_below(const std::vector<double>& sorted, double x) {
  const auto [first, last] = std::ranges::equal_range(sorted, x);
  const auto below = static_cast<double>(first - sorted.begin());
  return (below + 0.5 * static_cast<double>(last - first)) / static_cast<double>(sorted.size());
}

}  // namespace

Interval bootstrap_interval(std::span<const double> values, Statistic statistic,
                            const BootstrapOptions& options) {
  constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
  const bool finite = std::ranges::all_of(values, [](double x) { return std::isfinite(x); });
  if (values.size() < 2 || !finite || options.resamples < 1) return {undefined, undefined};
  const std::vector<double> drawn = resampled(values, statistic, options);
  // The whole sample may lie beyond all resamples: then the correction would be infinite.
  const double least = 0.5 / static_cast<double>(drawn.size());
  const double bias = normal_quantile(std::clamp(part_below(drawn, statistic(values)), least, 1.0 - least));
  const double accelerated = acceleration(values, statistic);
  const auto end = [&](double part) {
    const double z = bias + normal_quantile(part);
    const double corrected = bias + z / (1.0 - accelerated * z);
    return quantile(drawn, 0.5 * std::erfc(-corrected * M_SQRT1_2));
  };
  const double outside = 0.5 * (1.0 - options.confidence);
  return {end(outside), end(1.0 - outside)};
}

}  // namespace flyball
