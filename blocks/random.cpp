#include "blocks/random.h"

#include <cmath>

#include "blocks/hash.h"

namespace flyball {
namespace {

using Word = std::uint32_t;

Word low(std::uint64_t x) { return static_cast<Word>(x); }
Word high(std::uint64_t x) { return static_cast<Word>(x >> 32); }
std::uint64_t whole(double x) { return static_cast<std::uint64_t>(std::llround(x)); }

/// Two uniform numbers in (0, 1): 52 bits each, and half a unit away from both ends.
std::array<double, 2> uniform_pair(double stream, double k) {
  const std::uint64_t key = whole(stream), counter = whole(k);
  const auto bits = philox({low(counter), high(counter), 0, 0}, {low(key), high(key)});
  const auto number = [](Word a, Word b) {
    const std::uint64_t word = (static_cast<std::uint64_t>(a) << 32 | b) >> 12;
    return std::ldexp(static_cast<double>(word) + 0.5, -52);
  };
  return {number(bits[0], bits[1]), number(bits[2], bits[3])};
}

}  // namespace

std::array<Word, 4> philox(std::array<Word, 4> counter, std::array<Word, 2> key) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t a = std::uint64_t{0xD2511F53} * counter[0],
                        b = std::uint64_t{0xCD9E8D57} * counter[2];
    counter = {high(b) ^ counter[1] ^ key[0], low(b), high(a) ^ counter[3] ^ key[1], low(a)};
    key[0] += 0x9E3779B9;
    key[1] += 0xBB67AE85;
  }
  return counter;
}

double random_stream(std::uint64_t seed, std::string_view path) {
  const std::uint64_t name = fnv1a(path);
  const auto bits = philox({low(name), high(name), 0, 1}, {low(seed), high(seed)});
  return static_cast<double>((static_cast<std::uint64_t>(bits[0]) << 32 | bits[1]) >> 11);
}

double uniform_number(double stream, double k) { return uniform_pair(stream, k)[0]; }

// Box & Muller 1958.
double normal_number(double stream, double k) {
  const auto [a, b] = uniform_pair(stream, k);
  return std::sqrt(-2.0 * std::log(a)) * std::cos(2.0 * M_PI * b);
}

}  // namespace flyball
