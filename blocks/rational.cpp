#include "blocks/rational.h"

#include <cmath>
#include <limits>
#include <numeric>

namespace flyball {
namespace {

// Products of two 64-bit numbers fit 128 bits, so that overflow is judged once, after reduction.
__extension__ using Wide = __int128;

Wide gcd(Wide a, Wide b) {
  if (a < 0) a = -a;
  if (b < 0) b = -b;
  while (b != 0) {
    const Wide rest = a % b;
    a = b;
    b = rest;
  }
  return a;
}

std::optional<Rational> reduced(Wide numerator, Wide denominator) {
  if (denominator == 0) return std::nullopt;
  if (denominator < 0) {
    numerator = -numerator;
    denominator = -denominator;
  }
  constexpr Wide most = std::numeric_limits<std::int64_t>::max();
  if (denominator > 1) {
    const Wide divisor = gcd(numerator, denominator);
    numerator /= divisor;
    denominator /= divisor;
  }
  if (numerator > most || numerator < -most || denominator > most) return std::nullopt;
  if (denominator == 1) return Rational(static_cast<std::int64_t>(numerator));
  return Rational::fraction(static_cast<std::int64_t>(numerator), static_cast<std::int64_t>(denominator));
}

}  // namespace

std::optional<Rational> Rational::fraction(std::int64_t numerator, std::int64_t denominator) {
  if (denominator == 0) return std::nullopt;
  const Wide sign = denominator < 0 ? -1 : 1;
  const Wide divisor = sign * gcd(numerator, denominator);
  // The least number of 64 bits has no opposite.
  constexpr Wide most = std::numeric_limits<std::int64_t>::max();
  if (numerator / divisor > most || denominator / divisor > most) return std::nullopt;
  Rational result;
  result.numerator_ = static_cast<std::int64_t>(numerator / divisor);
  result.denominator_ = static_cast<std::int64_t>(denominator / divisor);
  return result;
}

std::optional<Rational> add(const Rational& a, const Rational& b) {
  return reduced(Wide(a.numerator()) * b.denominator() + Wide(b.numerator()) * a.denominator(),
                 Wide(a.denominator()) * b.denominator());
}

std::optional<Rational> subtract(const Rational& a, const Rational& b) {
  return reduced(Wide(a.numerator()) * b.denominator() - Wide(b.numerator()) * a.denominator(),
                 Wide(a.denominator()) * b.denominator());
}

std::optional<Rational> multiply(const Rational& a, const Rational& b) {
  return reduced(Wide(a.numerator()) * b.numerator(), Wide(a.denominator()) * b.denominator());
}

std::optional<Rational> divide(const Rational& a, const Rational& b) {
  return reduced(Wide(a.numerator()) * b.denominator(), Wide(a.denominator()) * b.numerator());
}

std::optional<Rational> nearest_fraction(double x) {
  constexpr double most = 1000.0;
  if (!(std::abs(x) <= most)) return std::nullopt;
  // A decimal or a quotient that was rounded to a double is off by half a unit in the last place.
  const double tolerance = std::numeric_limits<double>::epsilon() * std::abs(x);
  for (int denominator = 1; denominator <= static_cast<int>(most); ++denominator) {
    const double numerator = std::round(x * denominator);
    if (std::abs(numerator / denominator - x) > tolerance) continue;
    return Rational::fraction(static_cast<std::int64_t>(numerator), denominator);
  }
  return std::nullopt;
}

std::optional<Rational> common_divisor(const Rational& a, const Rational& b) {
  // gcd(a/b, c/d) = gcd(a*d, c*b) / (b*d)
  return reduced(gcd(Wide(a.numerator()) * b.denominator(), Wide(b.numerator()) * a.denominator()),
                 Wide(a.denominator()) * b.denominator());
}

}  // namespace flyball
