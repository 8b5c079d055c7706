#include "studies/language/sampling.h"

#include <fmt/format.h>

#include <cmath>

#include "blocks/random.h"

namespace flyball {
namespace {

/// A bijection of pairs of half words: a Feistel network whose round function is Philox.
std::uint64_t mixed(std::uint64_t word, int half, double stream) {
  constexpr std::uint32_t rounds = 4;
  const std::uint64_t mask = (std::uint64_t{1} << half) - 1;
  const auto key = static_cast<std::uint64_t>(stream);
  std::uint64_t left = word >> half, right = word & mask;
  for (std::uint32_t round = 0; round < rounds; ++round) {
    const auto random = philox({static_cast<std::uint32_t>(right), round, 0, 2},
                               {static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)});
    left ^= random[0] & mask;
    std::swap(left, right);
  }
  return left << half | right;
}

}  // namespace

std::int64_t permuted(std::int64_t k, std::int64_t count, double stream) {
  int half = 1;
  while ((std::int64_t{1} << (2 * half)) < count) ++half;
  // The network permutes 4^half numbers; the walk goes on until it is back among the first `count` ones.
  auto at = static_cast<std::uint64_t>(k);
  do at = mixed(at, half, stream);
  while (at >= static_cast<std::uint64_t>(count));
  return static_cast<std::int64_t>(at);
}

Sampler::Sampler(const MonteCarlo& monte_carlo, std::uint64_t seed) : monte_carlo_(monte_carlo), seed_(seed) {
  for (const auto& [name, spread] : monte_carlo.spread)
    streams_.push_back(random_stream(seed, "spread " + name));
}

double Sampler::uniform(int parameter, std::int64_t sample) const {
  const double stream = streams_[parameter], k = static_cast<double>(sample);
  switch (monte_carlo_.sampling) {
    case MonteCarlo::Sampling::random:
      return uniform_number(stream, k);
    case MonteCarlo::Sampling::latin_hypercube:
      // One sample in each of as many strata as there are runs, at a random place in it.
      return (static_cast<double>(permuted(sample, monte_carlo_.runs, stream)) + uniform_number(stream, k)) /
             monte_carlo_.runs;
    case MonteCarlo::Sampling::sobol: {
      // A random shift of the digits keeps what the sequence is good for, and makes it depend on the seed.
      const auto shift = static_cast<std::uint32_t>(std::ldexp(uniform_number(stream, 0.0), 32));
      return std::ldexp(static_cast<double>(sobol_bits(sample, parameter) ^ shift) + 0.5, -32);
    }
  }
  return 0.5;
}

double Sampler::draw(int parameter, std::int64_t sample) const {
  return monte_carlo_.spread[parameter].second.quantile(uniform(parameter, sample));
}

std::uint64_t Sampler::seed(std::int64_t sample) const {
  if (sample == 0) return seed_;
  return static_cast<std::uint64_t>(random_stream(seed_, fmt::format("sample {}", sample)));
}

}  // namespace flyball
