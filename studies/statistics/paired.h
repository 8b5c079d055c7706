#pragma once

#include <span>

#include "studies/statistics/bootstrap.h"

namespace flyball {

/// How much more b is than a, pair by pair.
struct PairedComparison {
  long pairs = 0;
  long missing = 0;         // pairs of which one side, or both, are not finite
  double difference = 0.0;  // mean of b - a
  Interval interval;        // BCa bootstrap of it
  /// How often chance alone would make a mean difference as large as this one, to either side, if it were as
  /// likely to be one way round as the other: a test that flips signs, R. A. Fisher, The Design of
  /// Experiments, 1935.
  double p_value = 0.0;
};

/// Compares runs that share their seeds. All ways to flip the signs of up to 12 pairs are tried; of more, as
/// many as options.resamples say.
PairedComparison compare_paired(std::span<const double> a, std::span<const double> b,
                                const BootstrapOptions& options = {});

}  // namespace flyball
