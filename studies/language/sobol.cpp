#include <array>

#include "studies/language/sampling.h"

namespace flyball {
namespace {

constexpr int bits = 32;

/// A primitive polynomial over GF(2), x^degree + … + 1 with its inner coefficients in `inner`, and the odd
/// numbers that begin the recurrence.
struct Generator {
  int degree;
  unsigned inner;
  std::array<unsigned, 7> first;
};

// Of dimension 1 on; dimension 0 is van der Corput's sequence. Joe and Kuo's table "new-joe-kuo-6".
constexpr std::array<Generator, sobol_dimensions - 1> generators{{
    {1, 0, {1}},
    {2, 1, {1, 3}},
    {3, 1, {1, 3, 1}},
    {3, 2, {1, 1, 1}},
    {4, 1, {1, 1, 3, 3}},
    {4, 4, {1, 3, 5, 13}},
    {5, 2, {1, 1, 5, 5, 17}},
    {5, 4, {1, 1, 5, 5, 5}},
    {5, 7, {1, 1, 7, 11, 19}},
    {5, 11, {1, 1, 5, 1, 1}},
    {5, 13, {1, 1, 1, 3, 11}},
    {5, 14, {1, 3, 5, 5, 31}},
    {6, 1, {1, 3, 3, 9, 7, 49}},
    {6, 13, {1, 1, 1, 15, 21, 21}},
    {6, 16, {1, 3, 1, 13, 27, 49}},
    {6, 19, {1, 1, 1, 15, 7, 5}},
    {6, 22, {1, 3, 1, 15, 13, 25}},
    {6, 25, {1, 1, 5, 5, 19, 61}},
    {7, 1, {1, 3, 7, 11, 23, 15, 103}},
    {7, 4, {1, 3, 7, 13, 13, 15, 69}},
}};

using Directions = std::array<std::uint32_t, bits>;

constexpr Directions directions(int dimension) {
  Directions v{};
  if (dimension == 0) {
    for (int k = 0; k < bits; ++k) v[k] = 1U << (bits - 1 - k);
    return v;
  }
  const Generator& generator = generators[dimension - 1];
  const int degree = generator.degree;
  for (int k = 0; k < degree; ++k) v[k] = generator.first[k] << (bits - 1 - k);
  for (int k = degree; k < bits; ++k) {
    v[k] = v[k - degree] ^ (v[k - degree] >> degree);
    for (int j = 1; j < degree; ++j) {
      if ((generator.inner >> (degree - 1 - j) & 1U) != 0) v[k] ^= v[k - j];
    }
  }
  return v;
}

constexpr auto all_directions = [] {
  std::array<Directions, sobol_dimensions> all{};
  for (int d = 0; d < sobol_dimensions; ++d) all[d] = directions(d);
  return all;
}();

}  // namespace

// In the order of Antonov and Saleev 1979: neighbours differ by one direction number, which also gives point
// k alone.
std::uint32_t sobol_bits(std::int64_t k, int dimension) {
  std::uint32_t point = 0;
  std::int64_t gray = k ^ (k >> 1);
  for (int bit = 0; gray != 0; ++bit, gray >>= 1) {
    if ((gray & 1) != 0) point ^= all_directions[dimension][bit];
  }
  return point;
}

}  // namespace flyball
