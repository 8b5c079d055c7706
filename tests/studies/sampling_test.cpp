#include "studies/language/sampling.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "tests/catch.h"

using namespace flyball;

namespace {

constexpr std::uint64_t study_seed = 3;

MonteCarlo cube(MonteCarlo::Sampling sampling, int runs, int dimensions) {
  MonteCarlo result;
  result.runs = runs;
  result.sampling = sampling;
  for (int d = 0; d < dimensions; ++d) result.spread.emplace_back("p" + std::to_string(d), Distribution{});
  return result;
}

/// T. T. Warnock's formula for the root mean square, over all boxes [0, x), of the difference between the
/// part of the points in the box and its volume.
double discrepancy(const Sampler& sampler, int runs, int dimensions) {
  double one = 0.0, two = 0.0;
  for (int i = 0; i < runs; ++i) {
    double product = 1.0;
    for (int d = 0; d < dimensions; ++d) product *= (1.0 - std::pow(sampler.uniform(d, i), 2)) / 2.0;
    one += product;
    for (int j = 0; j < runs; ++j) {
      double both = 1.0;
      for (int d = 0; d < dimensions; ++d)
        both *= 1.0 - std::max(sampler.uniform(d, i), sampler.uniform(d, j));
      two += both;
    }
  }
  const double n = runs;
  return std::sqrt(two / (n * n) - 2.0 * one / n + std::pow(3.0, -dimensions));
}

}  // namespace

TEST_CASE("the first points of Sobol's sequence are the published ones") {
  // Dimensions 1 to 3 in the order of Antonov and Saleev, in eighths.
  const int expected[][3] = {{0, 0, 0}, {4, 4, 4}, {6, 2, 2}, {2, 6, 6},
                             {3, 3, 5}, {7, 7, 1}, {5, 1, 7}, {1, 5, 3}};
  for (int k = 0; k < 8; ++k) {
    for (int d = 0; d < 3; ++d) CHECK(sobol_bits(k, d) == static_cast<std::uint32_t>(expected[k][d]) << 29);
  }
}

TEST_CASE("each coordinate of 2^m points of Sobol's sequence has one point in each of 2^m intervals") {
  for (int d = 0; d < sobol_dimensions; ++d) {
    for (const int m : {1, 4, 9}) {
      std::set<std::uint32_t> intervals;
      for (int k = 0; k < 1 << m; ++k) intervals.insert(sobol_bits(k, d) >> (32 - m));
      CAPTURE(d, m);
      CHECK(intervals.size() == std::size_t{1} << m);
    }
  }
}

TEST_CASE("the first two coordinates of Sobol's sequence are a net: one point in each box of equal volume") {
  constexpr int m = 8;
  for (int wide = 0; wide <= m; ++wide) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> boxes;
    for (int k = 0; k < 1 << m; ++k) {
      const auto part = [&](int d, int digits) {
        return digits == 0 ? 0 : sobol_bits(k, d) >> (32 - digits);
      };
      boxes.emplace(part(0, wide), part(1, m - wide));
    }
    CHECK(boxes.size() == std::size_t{1} << m);
  }
}

TEST_CASE("a permutation without a table is one") {
  for (const std::int64_t count : {1, 2, 3, 4, 5, 17, 64, 1000}) {
    std::set<std::int64_t> found;
    for (std::int64_t k = 0; k < count; ++k) found.insert(permuted(k, count, 42.0));
    CAPTURE(count);
    CHECK(static_cast<std::int64_t>(found.size()) == count);
    CHECK(*found.begin() == 0);
    CHECK(*found.rbegin() == count - 1);
  }
}

TEST_CASE("a Latin hypercube has one sample in each stratum of each parameter") {
  for (const int runs : {1, 7, 100}) {
    const Sampler sampler(cube(MonteCarlo::Sampling::latin_hypercube, runs, 3), study_seed);
    for (int d = 0; d < 3; ++d) {
      std::set<int> strata;
      for (int k = 0; k < runs; ++k) strata.insert(static_cast<int>(sampler.uniform(d, k) * runs));
      CHECK(static_cast<int>(strata.size()) == runs);
      CHECK(*strata.rbegin() == runs - 1);
    }
  }
}

TEST_CASE("parameters of a Latin hypercube are not correlated") {
  constexpr int runs = 1000;
  const Sampler sampler(cube(MonteCarlo::Sampling::latin_hypercube, runs, 2), study_seed);
  double sum = 0.0;
  for (int k = 0; k < runs; ++k) sum += (sampler.uniform(0, k) - 0.5) * (sampler.uniform(1, k) - 0.5);
  // The correlation of independent samples has the standard deviation 1/sqrt(1000); 4 of them.
  CHECK(std::abs(12.0 * sum / runs) < 4.0 / std::sqrt(runs));
}

TEST_CASE("samples depend on the seed, the parameter and their number alone") {
  for (const auto sampling : {MonteCarlo::Sampling::random, MonteCarlo::Sampling::sobol}) {
    const Sampler few(cube(sampling, 10, 2), study_seed), many(cube(sampling, 1000, 2), study_seed);
    const Sampler other(cube(sampling, 10, 2), study_seed + 1);
    for (int k = 0; k < 10; ++k) {
      CHECK(few.uniform(1, k) == many.uniform(1, k));
      CHECK(few.uniform(1, k) != other.uniform(1, k));
      CHECK(few.uniform(0, k) != few.uniform(1, k));
    }
  }
  const Sampler sampler(cube(MonteCarlo::Sampling::random, 10, 1), study_seed);
  CHECK(sampler.seed(0) == study_seed);
  std::set<std::uint64_t> seeds;
  for (int k = 0; k < 1000; ++k) seeds.insert(sampler.seed(k));
  CHECK(seeds.size() == 1000);
}

TEST_CASE("all samplings have the moments of the unit cube, the better ones closer") {
  constexpr int runs = 1024, dimensions = 5;
  const auto mean_error = [&](MonteCarlo::Sampling sampling) {
    const Sampler sampler(cube(sampling, runs, dimensions), study_seed);
    double worst = 0.0;
    for (int d = 0; d < dimensions; ++d) {
      double sum = 0.0;
      for (int k = 0; k < runs; ++k) sum += sampler.uniform(d, k);
      worst = std::max(worst, std::abs(sum / runs - 0.5));
    }
    return worst;
  };
  // The mean of independent samples has the standard deviation 1/sqrt(12 runs) = 0.009; 4 of them.
  CHECK(mean_error(MonteCarlo::Sampling::random) < 0.036);
  // One sample a stratum: 1/sqrt(12 runs^3) = 9e-6; 4 of them. Sobol's points are half a stratum off at most.
  CHECK(mean_error(MonteCarlo::Sampling::latin_hypercube) < 3.6e-5);
  CHECK(mean_error(MonteCarlo::Sampling::sobol) < 0.5 / runs);
}

TEST_CASE("Sobol's points fill a cube more evenly than random ones") {
  constexpr int runs = 512, dimensions = 6;
  const Sampler random(cube(MonteCarlo::Sampling::random, runs, dimensions), study_seed);
  const Sampler sobol(cube(MonteCarlo::Sampling::sobol, runs, dimensions), study_seed);
  const double expected = std::sqrt((std::pow(2.0, -dimensions) - std::pow(3.0, -dimensions)) / runs);
  const double of_random = discrepancy(random, runs, dimensions);
  // The mean square of random points is known; a single set of them is not far from it.
  CHECK(of_random > expected / 2.0);
  CHECK(of_random < expected * 2.0);
  CHECK(discrepancy(sobol, runs, dimensions) < of_random / 2.0);
}

TEST_CASE("normal quantiles invert the distribution") {
  CHECK(normal_quantile(0.5) == 0.0);
  // Tables of the normal distribution, to all digits of a double.
  CHECK(normal_quantile(0.975) == Approx(1.959963984540054).epsilon(2e-15));
  CHECK(normal_quantile(1e-10) == Approx(-6.361340902404056).epsilon(2e-15));
  CHECK(normal_quantile(1e-300) == Approx(-37.0471).epsilon(1e-5));
  for (double p = 1e-15; p < 0.5; p *= 1.7) {
    const double z = normal_quantile(p);
    // erfc is good to a few units of rounding, and its condition is about z^2.
    CHECK(0.5 * std::erfc(-z / std::sqrt(2.0)) == Approx(p).epsilon(1e-15 * (2.0 + z * z)));
    // In 1 - p, p is only kept to rounding of 1, which the slope of the quantile enlarges.
    const double slope = std::sqrt(2.0 * M_PI) * std::exp(0.5 * z * z);
    CHECK(normal_quantile(1.0 - p) == Approx(-z).margin(1.2e-16 * slope + 1e-14));
  }
}

TEST_CASE("distributions have their moments and ends") {
  using Kind = Distribution::Kind;
  struct Case {
    Distribution distribution;
    double mean, variance;
  };
  const double s = std::log(1.3);
  const std::vector<Case> cases{
      {{Kind::uniform, -1.0, 3.0, 0.0, {}, {}, {}}, 1.0, 16.0 / 12.0},
      {{Kind::normal, 2.0, 0.5, 0.0, {}, {}, {}}, 2.0, 0.25},
      {{Kind::lognormal, 2.0, 1.3, 0.0, {}, {}, {}},
       2.0 * std::exp(s * s / 2.0),
       4.0 * (std::exp(s * s) - 1.0) * std::exp(s * s)},
      {{Kind::triangular, 0.0, 4.0, 1.0, {}, {}, {}}, 5.0 / 3.0, 13.0 / 18.0},
      {{Kind::choice, 0.0, 1.0, 0.0, {}, {}, {1.0, 2.0, 6.0}}, 3.0, 14.0 / 3.0},
  };
  constexpr int n = 100'000;
  for (const auto& [distribution, mean, variance] : cases) {
    double sum = 0.0, squares = 0.0;
    for (int k = 0; k < n; ++k) {
      const double x = distribution.quantile((k + 0.5) / n);
      sum += x;
      squares += (x - mean) * (x - mean);
    }
    CAPTURE(static_cast<int>(distribution.kind));
    // The rule of midpoints on quantiles leaves out tails of a part of 1/(2 n), some 4.4 deviations out.
    CHECK(sum / n == Approx(mean).epsilon(1e-4));
    CHECK(squares / n == Approx(variance).epsilon(1e-3));
  }
}

TEST_CASE("a truncated distribution is drawn within its ends") {
  using Kind = Distribution::Kind;
  const Distribution far{Kind::normal, 0.0, 1.0, 0.0, 10.0, 11.0, {}};
  // The tail beyond 10 deviations is nearly exponential: its median is near 10 + log(2)/10.
  CHECK(far.quantile(0.5) == Approx(10.0 + std::log(2.0) / 10.0).epsilon(1e-3));
  CHECK(far.quantile(1e-9) >= 10.0);
  CHECK(far.quantile(1.0 - 1e-9) <= 11.0);
  const Distribution middle{Kind::normal, 5.0, 2.0, 0.0, 4.0, 6.0, {}};
  CHECK(middle.quantile(0.5) == Approx(5.0).epsilon(1e-15));
  CHECK(middle.quantile(0.9) == Approx(10.0 - middle.quantile(0.1)).epsilon(1e-14));
  const Distribution log{Kind::lognormal, 1.0, 2.0, 0.0, 0.5, 2.0, {}};
  // Symmetric in the logarithm: the median of the part is that of the whole.
  CHECK(log.quantile(0.5) == Approx(1.0).epsilon(1e-14));
  CHECK(log.quantile(0.0001) >= 0.5);
}
