#include "studies/engine/interval_of_mean.h"

#include <cmath>

#include "studies/statistics/sample.h"

namespace flyball {

Interval interval_of_mean(std::span<const double> x, std::uint64_t seed) {
  constexpr std::size_t most_resampled = 2000;
  if (x.size() <= most_resampled) {
    BootstrapOptions options;
    options.seed = seed;
    return bootstrap_interval(x, mean, options);
  }
  constexpr double normal_quantile = 1.959963984540054;  // of 0.975
  const double middle = mean(x);
  const double half = normal_quantile * standard_deviation(x) / std::sqrt(static_cast<double>(x.size()));
  return {middle - half, middle + half};
}

}  // namespace flyball
