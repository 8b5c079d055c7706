#pragma once

#include <cstdint>
#include <optional>

namespace flyball {

/// An exact fraction in lowest terms, denominator > 0. Sample times are structure, kept exact so that
/// tick k falls on the double nearest to k*numerator/denominator, however large k is.
class Rational {
 public:
  constexpr Rational() = default;
  constexpr Rational(std::int64_t whole) : numerator_(whole) {}

  /// Nothing when the denominator is zero, or the result does not fit 64 bits.
  static std::optional<Rational> fraction(std::int64_t numerator, std::int64_t denominator);

  std::int64_t numerator() const { return numerator_; }
  std::int64_t denominator() const { return denominator_; }
  double value() const { return static_cast<double>(numerator_) / static_cast<double>(denominator_); }

  bool operator==(const Rational&) const = default;

 private:
  std::int64_t numerator_ = 0;
  std::int64_t denominator_ = 1;
};

/// Exact arithmetic; nothing when the result does not fit 64 bits (or on division by zero).
std::optional<Rational> add(const Rational& a, const Rational& b);
std::optional<Rational> subtract(const Rational& a, const Rational& b);
std::optional<Rational> multiply(const Rational& a, const Rational& b);
std::optional<Rational> divide(const Rational& a, const Rational& b);

/// The fraction of small denominator that a double stands for: 0.3 for 3/10, 0.333… for 1/3. Nothing when
/// there is none.
std::optional<Rational> nearest_fraction(double x);

/// Greatest common divisor of two non-negative fractions: the largest fraction that both are multiples of.
std::optional<Rational> common_divisor(const Rational& a, const Rational& b);

}  // namespace flyball
