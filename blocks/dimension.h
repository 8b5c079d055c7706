#pragma once

#include <array>
#include <cstdint>

namespace flyball {

inline constexpr int base_units = 7;

/// Exponents of the SI base units m, kg, s, A, K, mol, cd. Radians count as numbers.
struct Dimension {
  std::array<std::int8_t, base_units> exponent{};

  bool operator==(const Dimension&) const = default;
};

}  // namespace flyball
