#pragma once

#include <array>
#include <cstdint>

namespace flyball {

/// Exponents of the SI base units m, kg, s, A, K, mol, cd. Radians count as numbers.
struct Dimension {
  std::array<std::int8_t, 7> exponent{};

  bool operator==(const Dimension&) const = default;
};

}  // namespace flyball
