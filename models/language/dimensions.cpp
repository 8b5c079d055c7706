// Arithmetic of dimensions, beside the units that they come from.
#include <fmt/format.h>

#include <limits>
#include <map>

#include "models/language/units.h"

namespace flyball {
namespace {

constexpr std::array<const char*, base_units> base_names{"m", "kg", "s", "A", "K", "mol", "cd"};

template <class Combine>
std::optional<Dimension> combined(const Dimension& a, const Dimension& b, Combine combine) {
  Dimension result;
  for (std::size_t k = 0; k < result.exponent.size(); ++k) {
    const int exponent = combine(a.exponent[k], b.exponent[k]);
    if (exponent < std::numeric_limits<std::int8_t>::min() ||
        exponent > std::numeric_limits<std::int8_t>::max()) {
      return std::nullopt;
    }
    result.exponent[k] = static_cast<std::int8_t>(exponent);
  }
  return result;
}

/// Units with a name of their own, by which people know them in a message.
const char* named_unit(const Dimension& dimension) {
  static const std::vector<std::pair<Dimension, const char*>> named = [] {
    std::vector<std::pair<Dimension, const char*>> all;
    for (const char* unit : {"N", "J", "W", "Pa", "V", "ohm", "F", "H", "T"})
      all.emplace_back(parse_unit(unit).dimension, unit);
    return all;
  }();
  for (const auto& [known, unit] : named) {
    if (known == dimension) return unit;
  }
  return nullptr;
}

}  // namespace

std::optional<Dimension> multiply(const Dimension& a, const Dimension& b) {
  return combined(a, b, [](int x, int y) { return x + y; });
}

std::optional<Dimension> divide(const Dimension& a, const Dimension& b) {
  return combined(a, b, [](int x, int y) { return x - y; });
}

std::optional<Dimension> power(const Dimension& a, const Rational& exponent) {
  Dimension result;
  for (std::size_t k = 0; k < result.exponent.size(); ++k) {
    const auto scaled = multiply(Rational(a.exponent[k]), exponent);
    if (!scaled || scaled->denominator() != 1 || std::abs(scaled->numerator()) > 127) return std::nullopt;
    result.exponent[k] = static_cast<std::int8_t>(scaled->numerator());
  }
  return result;
}

std::string to_string(const Dimension& dimension) {
  if (const char* name = named_unit(dimension)) return name;
  // kg first, as the field writes it.
  constexpr std::array<std::size_t, 7> order{1, 0, 2, 3, 4, 5, 6};
  std::string above, below;
  int divisors = 0;
  for (const std::size_t k : order) {
    const int exponent = dimension.exponent[k];
    if (exponent == 0) continue;
    std::string& side = exponent > 0 ? above : below;
    if (!side.empty()) side += '*';
    side += base_names[k];
    if (std::abs(exponent) > 1) side += fmt::format("^{}", std::abs(exponent));
    if (exponent < 0) ++divisors;
  }
  if (above.empty()) above += '1';
  if (below.empty()) return above;
  return divisors > 1 ? fmt::format("{}/({})", above, below) : fmt::format("{}/{}", above, below);
}

std::optional<Dimension> declared_dimension(const std::string& unit) {
  if (unit == "any") return std::nullopt;
  static thread_local std::map<std::string, Dimension> known;
  auto found = known.find(unit);
  if (found == known.end()) found = known.emplace(unit, parse_unit(unit).dimension).first;
  return found->second;
}

}  // namespace flyball
