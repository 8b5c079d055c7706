#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "blocks/scalar.h"

namespace flyball {

/// Philox4x32-10 (Salmon, Moraes, Dror, Shaw: Parallel random numbers, as easy as 1, 2, 3. SC 2011): 128
/// random bits for a counter, under a key. There is no state: the same counter gives the same bits.
std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key);

/// The key of a noise block's own numbers: a whole number below 2^53, so that a slot holds it exactly.
double random_stream(std::uint64_t seed, std::string_view path);

/// Number k of a stream: uniform in (0, 1), and normal with mean 0 and variance 1.
double uniform_number(double stream, double k);
double normal_number(double stream, double k);

/// The same on any scalar: a random number has no derivative. For scalars without a value only the form
/// counts: it depends on both, which are numbers.
template <class T>
T random_number(const T& stream, const T& k, double (*number)(double, double)) {
  if constexpr (requires { value_of(k); }) {
    return T(number(value_of(stream), value_of(k)));
  } else if constexpr (requires { each(stream, k, number); }) {
    return each(stream, k, number);
  } else {
    return wrap(stream * k);
  }
}
template <class T>
T uniform(const T& stream, const T& k) {
  return random_number(stream, k, uniform_number);
}
template <class T>
T normal(const T& stream, const T& k) {
  return random_number(stream, k, normal_number);
}

}  // namespace flyball
