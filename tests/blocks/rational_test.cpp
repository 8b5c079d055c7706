#include "blocks/rational.h"

#include <limits>

#include "tests/catch.h"

namespace flyball::test {
namespace {

constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t least = std::numeric_limits<std::int64_t>::min();

Rational fraction(std::int64_t numerator, std::int64_t denominator) {
  return Rational::fraction(numerator, denominator).value();
}

}  // namespace

TEST_CASE("a fraction is kept in lowest terms with a positive denominator") {
  CHECK(fraction(6, 4).numerator() == 3);
  CHECK(fraction(6, 4).denominator() == 2);
  CHECK(fraction(6, -4) == fraction(-3, 2));
  CHECK(fraction(-6, -4) == fraction(3, 2));
  CHECK(fraction(0, -7) == Rational(0));
  CHECK(fraction(1, 4).value() == 0.25);
  CHECK_FALSE(Rational::fraction(1, 0).has_value());
}

TEST_CASE("fractions at the ends of 64 bits are exact or nothing") {
  CHECK(fraction(least, 2) == Rational(least / 2));
  CHECK(fraction(least, 1).numerator() == least);
  CHECK_FALSE(Rational::fraction(least, -1).has_value());
  CHECK_FALSE(Rational::fraction(1, least).has_value());
}

TEST_CASE("arithmetic on fractions is exact") {
  CHECK(add(fraction(1, 6), fraction(1, 10)) == fraction(4, 15));
  CHECK(subtract(fraction(1, 6), fraction(1, 10)) == fraction(1, 15));
  CHECK(multiply(fraction(2, 3), fraction(9, 4)) == fraction(3, 2));
  CHECK(divide(fraction(2, 3), fraction(-4, 9)) == fraction(-3, 2));
  CHECK_FALSE(divide(fraction(2, 3), Rational(0)).has_value());
}

TEST_CASE("what does not fit is nothing, and what fits after reduction is kept") {
  CHECK_FALSE(add(Rational(most), Rational(1)).has_value());
  CHECK_FALSE(multiply(Rational(most), Rational(2)).has_value());
  CHECK_FALSE(multiply(fraction(1, most), fraction(1, 2)).has_value());
  CHECK(multiply(Rational(most), fraction(2, most)) == Rational(2));
  CHECK(add(Rational(most), Rational(-most)) == Rational(0));
}

TEST_CASE("the common divisor is the largest fraction that divides both") {
  CHECK(common_divisor(fraction(1, 3), fraction(1, 4)) == fraction(1, 12));
  CHECK(common_divisor(fraction(1, 100), fraction(3, 1000)) == fraction(1, 1000));
  CHECK(common_divisor(Rational(0), fraction(2, 5)) == fraction(2, 5));
}

}  // namespace flyball::test
