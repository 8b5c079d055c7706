#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "studies/language/study.h"

namespace flyball {

/// The draws of [monte_carlo]: sample k of a parameter, a function of the study's seed, the parameter and k.
/// With random and Sobol sampling, more runs keep the samples of fewer runs; a Latin hypercube has its strata
/// from the number of runs, and has no such beginning.
class Sampler {
 public:
  Sampler(const MonteCarlo& monte_carlo, std::uint64_t seed);

  /// In SI; `parameter` counts in MonteCarlo::spread.
  double draw(int parameter, std::int64_t sample) const;
  /// The same before its distribution: in (0, 1).
  double uniform(int parameter, std::int64_t sample) const;
  /// The seed of the noise of a sample; that of the first one is the study's own.
  std::uint64_t seed(std::int64_t sample) const;

 private:
  MonteCarlo monte_carlo_;
  std::uint64_t seed_;
  std::vector<double> streams_;  // of each parameter
};

/// Element k of a permutation of 0 … count - 1 that `stream` chooses, without a table of it.
std::int64_t permuted(std::int64_t k, std::int64_t count, double stream);

/// As many parameters can be sampled by Sobol's sequence.
inline constexpr int sobol_dimensions = 21;

/// Coordinate `dimension` of point k of Sobol's sequence, as 32 bits behind the point: Sobol 1967, with the
/// direction numbers of S. Joe, F. Y. Kuo: Constructing Sobol sequences with better two-dimensional
/// projections, SIAM J. Sci. Comput. 30 (2008). 0 <= k < 2^32.
std::uint32_t sobol_bits(std::int64_t k, int dimension);

/// The value below which the part p of a standard normal distribution lies, 0 < p < 1, to rounding.
double normal_quantile(double p);

}  // namespace flyball
