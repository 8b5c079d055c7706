#include <cmath>
#include <limits>
#include <vector>

#include "blocks/random.h"
#include "studies/statistics/paired.h"
#include "studies/statistics/sample.h"
#include "tests/catch.h"

using namespace flyball;

namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

/// Normal numbers of the given mean; each `sample` is another one.
std::vector<double> normal_sample(int sample, int size, double middle) {
  const double stream = random_stream(static_cast<std::uint64_t>(sample), "statistics test");
  std::vector<double> values;
  for (int k = 0; k < size; ++k) values.push_back(middle + normal_number(stream, k));
  return values;
}

}  // namespace

TEST_CASE("Statistics: mean, deviation and quantiles of known samples") {
  const std::vector<double> values{4.0, 1.0, 3.0, 2.0};
  CHECK(mean(values) == 2.5);
  CHECK(standard_deviation(values) == Approx(std::sqrt(5.0 / 3.0)).epsilon(1e-15));
  CHECK(quantile(values, 0.0) == 1.0);
  CHECK(quantile(values, 0.25) == 1.75);
  CHECK(quantile(values, 0.5) == 2.5);
  CHECK(quantile(values, 0.9) == Approx(3.7).epsilon(1e-15));
  CHECK(quantile(values, 1.0) == 4.0);
  CHECK(quantile(std::vector{7.0}, 0.3) == 7.0);
}

TEST_CASE("Statistics: the deviation does not suffer from a large mean") {
  const std::vector<double> values{1e9 + 4.0, 1e9 + 7.0, 1e9 + 13.0, 1e9 + 16.0};
  CHECK(standard_deviation(values) == Approx(std::sqrt(30.0)).epsilon(1e-15));
  CHECK(standard_deviation(std::vector(1000, 0.1)) == 0.0);
}

TEST_CASE("Statistics: what is missing is counted, and none of it is used") {
  const std::vector<double> numbers{1.0, missing, 3.0, std::numeric_limits<double>::infinity()};
  const Sample sample(numbers);
  CHECK(sample.missing == 2);
  CHECK(sample.values == std::vector{1.0, 3.0});
  CHECK(std::isnan(mean({})));
  CHECK(std::isnan(quantile({}, 0.5)));
  CHECK(std::isnan(standard_deviation(std::vector{1.0})));
  CHECK(std::isnan(bootstrap_interval(std::vector{1.0}, mean).lower));
  CHECK(std::isnan(bootstrap_interval(numbers, mean).upper));
}

TEST_CASE("Statistics: a bootstrap interval holds the true mean as often as it says") {
  int held = 0;
  constexpr int samples = 1000;
  for (int k = 0; k < samples; ++k) {
    const Interval interval = bootstrap_interval(normal_sample(k, 30, 5.0), mean, {0.9, 500, 7});
    if (interval.lower <= 5.0 && 5.0 <= interval.upper) ++held;
  }
  // BCa is short of its confidence by O(1/n), about 0.02 here; the count itself spreads by
  // sqrt(0.9*0.1*1000) = 9.5, of which three are allowed.
  CHECK(held > 900 - 20 - 29);
  CHECK(held < 900 + 29);
}

TEST_CASE("Statistics: a bootstrap interval of a mean is as wide as theory says") {
  const std::vector<double> values = normal_sample(3, 400, 0.0);
  const Interval interval = bootstrap_interval(values, mean, {0.95, 4000, 1});
  const double standard_error = standard_deviation(values) / 20.0;
  // The 2.5 % quantile of 4000 resamples spreads by about 0.03 of their deviation, at each end.
  CHECK(interval.upper - interval.lower == Approx(2.0 * 1.96 * standard_error).epsilon(0.06));
  CHECK(0.5 * (interval.upper + interval.lower) == Approx(mean(values)).margin(0.1 * standard_error));
}

TEST_CASE("Statistics: the interval of a skewed sample is skewed to the same side") {
  std::vector<double> values = normal_sample(5, 60, 0.0);
  for (double& x : values) x = std::exp(x);
  const Interval interval = bootstrap_interval(values, mean);
  CHECK(interval.upper - mean(values) > 1.1 * (mean(values) - interval.lower));
}

TEST_CASE("Statistics: equal options give equal bits, another seed gives others") {
  const std::vector<double> values = normal_sample(1, 50, 0.0);
  const Interval first = bootstrap_interval(values, mean), again = bootstrap_interval(values, mean);
  CHECK(first.lower == again.lower);
  CHECK(first.upper == again.upper);
  CHECK(bootstrap_interval(values, mean, {0.95, 2000, 2}).lower != first.lower);
}

TEST_CASE("Statistics: values that are all equal have an interval without width") {
  const Interval interval = bootstrap_interval(std::vector(10, 2.5), mean);
  CHECK(interval.lower == 2.5);
  CHECK(interval.upper == 2.5);
}

TEST_CASE("Statistics: pairs that all go one way have the p-value of their number") {
  const std::vector<double> a{1.0, 2.0, 3.0, 4.0, 5.0}, b{1.5, 2.4, 3.3, 4.2, 5.6};
  const PairedComparison comparison = compare_paired(a, b);
  CHECK(comparison.pairs == 5);
  CHECK(comparison.difference == Approx(0.4).epsilon(1e-12));
  // Two of the 32 ways are as far from zero.
  CHECK(comparison.p_value == 2.0 / 32.0);
  CHECK(comparison.interval.lower > 0.2);
  CHECK(comparison.interval.upper < 0.6);
}

TEST_CASE("Statistics: pairing finds a difference that is small against the spread") {
  std::vector<double> a = normal_sample(9, 100, 0.0), b = a;
  const std::vector<double> noise = normal_sample(10, 100, 0.0);
  for (std::size_t k = 0; k < b.size(); ++k) b[k] += 0.05 + 0.1 * noise[k];
  const PairedComparison comparison = compare_paired(a, b);
  CHECK(comparison.interval.lower > 0.0);
  CHECK(comparison.p_value < 0.01);
  // The other way round it is the same, the other way round.
  CHECK(compare_paired(b, a).difference == Approx(-comparison.difference).epsilon(1e-12));
  CHECK(compare_paired(b, a).p_value == comparison.p_value);
}

TEST_CASE("Statistics: where there is no difference, p-values are as rare as they say") {
  int below = 0;
  constexpr int samples = 1000;
  for (int k = 0; k < samples; ++k) {
    const std::vector<double> zero(20, 0.0), differences = normal_sample(k + 5000, 20, 0.0);
    if (compare_paired(zero, differences, {0.95, 200, 3}).p_value <= 0.05) ++below;
  }
  // 50 are expected, with a spread of 7, of which three are allowed.
  CHECK(below > 50 - 21);
  CHECK(below < 50 + 21);
}

TEST_CASE("Statistics: pairs with a missing side are counted and left out") {
  const std::vector<double> a{1.0, missing, 3.0, 4.0}, b{2.0, 2.0, missing, 6.0};
  const PairedComparison comparison = compare_paired(a, b);
  CHECK(comparison.pairs == 2);
  CHECK(comparison.missing == 2);
  CHECK(comparison.difference == 1.5);
  CHECK(std::isnan(compare_paired({}, {}).p_value));
}
