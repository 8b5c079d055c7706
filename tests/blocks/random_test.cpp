// Random numbers: the generator against its published answers, and the statistics of the blocks. Seeds are
// fixed, so a bound of four standard deviations (met by chance in 1 of 16000 cases) is met always or never.
#include <cmath>
#include <functional>

#include "blocks/random.h"
#include "tests/blocks/bench.h"
#include "tests/catch.h"

namespace flyball::test {
namespace {

constexpr int many = 100000;
const double deviation_of_mean = 1.0 / std::sqrt(many);

/// Outputs of a block at many hits, with the stream of an instance of this name.
std::vector<double> outputs(const std::string& type, Keys keys, const std::string& name,
                            std::uint64_t seed = 1) {
  keys.insert({"sample_time", *Rational::fraction(1, 100)});
  Device d(type, keys);
  d["stream"] = random_stream(seed, name);
  std::vector<double> all;
  for (int k = 0; k < many; ++k) all.push_back(d.hit("y"));
  return all;
}

double mean_of(const std::vector<double>& x, const std::function<double(int)>& value) {
  double sum = 0.0;
  for (int k = 0; k < static_cast<int>(x.size()); ++k) sum += value(k);
  return sum / static_cast<double>(x.size());
}

}  // namespace

TEST_CASE("Philox gives its published answers") {
  // Known-answer tests of Random123, philox4x32 with 10 rounds.
  using Bits = std::array<std::uint32_t, 4>;
  CHECK(philox({0, 0, 0, 0}, {0, 0}) == Bits{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
  constexpr std::uint32_t f = 0xffffffff;
  CHECK(philox({f, f, f, f}, {f, f}) == Bits{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
  CHECK(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}) ==
        Bits{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
}

TEST_CASE("A stream is a whole number of its own for each seed and each path") {
  for (const double stream : {random_stream(1, "a"), random_stream(2, "a"), random_stream(1, "b")}) {
    CHECK(stream == std::floor(stream));
    CHECK((stream >= 0.0 && stream < 0x1p53));
  }
  CHECK(random_stream(1, "a") == random_stream(1, "a"));
  CHECK(random_stream(1, "a") != random_stream(2, "a"));
  CHECK(random_stream(1, "a") != random_stream(1, "b"));
}

TEST_CASE("RandomNumber is normal, with the mean and deviation that it names, and uncorrelated") {
  const std::vector<double> y = outputs("RandomNumber", {{"mean", 3.0}, {"deviation", 2.0}}, "noise");
  const auto z = [&](int k) { return (y[k] - 3.0) / 2.0; };
  CHECK(std::fabs(mean_of(y, z)) < 4.0 * deviation_of_mean);
  // z^2 has the variance 2, z^3 15 and z^4 96.
  const auto power = [&](int n) { return mean_of(y, [&](int k) { return std::pow(z(k), n); }); };
  CHECK(std::fabs(power(2) - 1.0) < 4.0 * std::sqrt(2.0) * deviation_of_mean);
  CHECK(std::fabs(power(3)) < 4.0 * std::sqrt(15.0) * deviation_of_mean);
  CHECK(std::fabs(power(4) - 3.0) < 4.0 * std::sqrt(96.0) * deviation_of_mean);
  for (int lag = 1; lag <= 10; ++lag) {
    INFO("lag " << lag);
    CHECK(std::fabs(mean_of(y, [&](int k) { return z(k) * z((k + lag) % many); })) < 4.0 * deviation_of_mean);
  }
  // Kolmogorov & Smirnov: the distance is above 1.95/sqrt(n) by chance in 1 of 1000 cases.
  std::vector<double> sorted;
  for (int k = 0; k < many; ++k) sorted.push_back(z(k));
  std::ranges::sort(sorted);
  double distance = 0.0;
  for (int k = 0; k < many; ++k) {
    const double normal = 0.5 * std::erfc(-sorted[k] / std::sqrt(2.0));
    distance = std::max(distance, std::fabs(normal - (k + 0.5) / many));
  }
  CHECK(distance < 1.95 * deviation_of_mean);
}

TEST_CASE("Two paths, and two seeds, give independent numbers") {
  const std::vector<double> a = outputs("RandomNumber", {}, "a"), b = outputs("RandomNumber", {}, "b"),
                            other = outputs("RandomNumber", {}, "a", 2);
  CHECK(std::fabs(mean_of(a, [&](int k) { return a[k] * b[k]; })) < 4.0 * deviation_of_mean);
  CHECK(std::fabs(mean_of(a, [&](int k) { return a[k] * other[k]; })) < 4.0 * deviation_of_mean);
}

TEST_CASE("UniformRandomNumber fills its interval evenly") {
  const std::vector<double> y = outputs("UniformRandomNumber", {{"lower", 2.0}, {"upper", 6.0}}, "noise");
  std::vector<int> bins(10);
  for (const double x : y) {
    REQUIRE((x > 2.0 && x < 6.0));
    ++bins[static_cast<int>((x - 2.0) / 0.4)];
  }
  // A bin holds n/10 with the variance n 0.1 0.9; the largest of ten is within four deviations as well.
  for (const int count : bins) CHECK(std::abs(count - many / 10) < 4.0 * std::sqrt(many * 0.09));
}

TEST_CASE("BandLimitedWhiteNoise has its density at low frequencies: its integral diffuses") {
  const double power = 0.3, ts = 0.01;
  const std::vector<double> y = outputs("BandLimitedWhiteNoise", {{"power", power}}, "noise");
  // The integral over T of white noise has the variance power T.
  const int length = 500, pieces = many / length;
  double sum = 0.0;
  for (int piece = 0; piece < pieces; ++piece) {
    double integral = 0.0;
    for (int k = piece * length; k < (piece + 1) * length; ++k) integral += y[k] * ts;
    sum += integral * integral;
  }
  const double relative = sum / pieces / (power * length * ts);
  CHECK(std::fabs(relative - 1.0) < 4.0 * std::sqrt(2.0 / pieces));
}

}  // namespace flyball::test
