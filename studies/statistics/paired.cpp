#include "studies/statistics/paired.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "blocks/random.h"
#include "studies/statistics/sample.h"

namespace flyball {
namespace {

constexpr std::size_t most_tried = 12;

/// Counts flips whose sum is as far from zero as the one that was found, which rounding must not push out.
class FlipCount {
 public:
  explicit FlipCount(const std::vector<double>& differences) : differences_(differences) {
    double size = 0.0;
    for (const double d : differences) size += std::fabs(d);
    limit_ = std::fabs(sum([](std::size_t) { return false; })) - 1e-12 * size;
  }

  void count(auto&& flipped) {
    ++tried_;
    if (std::fabs(sum(flipped)) >= limit_) ++as_far_;
  }
  double tried() const { return static_cast<double>(tried_); }
  double as_far() const { return static_cast<double>(as_far_); }

 private:
  double sum(auto&& flipped) const {
    double total = 0.0;
    for (std::size_t k = 0; k < differences_.size(); ++k)
      total += flipped(k) ? -differences_[k] : differences_[k];
    return total;
  }

  const std::vector<double>& differences_;
  double limit_ = 0.0;
  long tried_ = 0, as_far_ = 0;
};

double sign_flip_test(const std::vector<double>& differences, const BootstrapOptions& options) {
  FlipCount flips(differences);
  if (differences.size() <= most_tried) {
    const std::size_t ways = std::size_t{1} << differences.size();
    for (std::size_t way = 0; way < ways; ++way)
      flips.count([&](std::size_t k) { return (way >> k & 1) != 0; });
    return flips.as_far() / flips.tried();
  }
  const double stream = random_stream(options.seed, "sign flips");
  double number = 0.0;
  for (int k = 0; k < options.resamples; ++k)
    flips.count([&](std::size_t) { return uniform_number(stream, number++) < 0.5; });
  // What was found is one of the ways: a p-value is never 0.
  return (flips.as_far() + 1.0) / (flips.tried() + 1.0);
}

}  // namespace

PairedComparison compare_paired(std::span<const double> a, std::span<const double> b,
                                const BootstrapOptions& options) {
  std::vector<double> differences;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) differences.push_back(b[k] - a[k]);
  const Sample sample(differences);
  PairedComparison result;
  result.pairs = static_cast<long>(sample.values.size());
  result.missing = static_cast<long>(std::max(a.size(), b.size())) - result.pairs;
  result.difference = mean(sample.values);
  result.interval = bootstrap_interval(sample.values, mean, options);
  result.p_value = sample.values.empty() ? std::numeric_limits<double>::quiet_NaN()
                                         : sign_flip_test(sample.values, options);
  return result;
}

}  // namespace flyball
