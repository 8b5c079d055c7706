#pragma once

#include <span>
#include <vector>

namespace flyball {

/// What is left of numbers of which some are missing: NaN and infinities are counted, and never used.
struct Sample {
  std::vector<double> values;  // in their order
  long missing = 0;

  Sample() = default;
  explicit Sample(std::span<const double> numbers);
};

/// All of them are NaN without values; the deviation is without two.
double mean(std::span<const double> values);
/// With n - 1 in the denominator.
double standard_deviation(std::span<const double> values);
/// The value below which the part p lies: definition 7 of R. J. Hyndman, Y. Fan: Sample quantiles in
/// statistical packages, 1996, which is linear between the values in order, at (n - 1) p from 0. That of
/// NumPy and R.
double quantile(std::span<const double> values, double p);

}  // namespace flyball
