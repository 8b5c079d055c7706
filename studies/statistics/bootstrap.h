#pragma once

#include <cstdint>
#include <span>

namespace flyball {

struct Interval {
  double lower = 0.0, upper = 0.0;
};

struct BootstrapOptions {
  double confidence = 0.95;
  int resamples = 2000;
  std::uint64_t seed = 1;
};

/// An interval that holds the true value of a statistic with the confidence that was asked for, whatever the
/// values are distributed like: bias-corrected and accelerated (BCa), B. Efron, J. Am. Stat. Assoc. 82, 1987.
/// The same values and options give the same bits. NaN for less than two values, and for values that are not
/// finite.
Interval bootstrap_interval(std::span<const double> values, double (*statistic)(std::span<const double>),
                            const BootstrapOptions& options = {});

}  // namespace flyball
