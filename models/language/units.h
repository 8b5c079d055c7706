#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "blocks/dimension.h"
#include "blocks/rational.h"
#include "models/language/text_error.h"

namespace flyball {

/// What a unit's text stands for: a value in it, times `factor`, plus `offset`, is the value in SI.
struct Unit {
  double factor = 1.0;
  std::optional<Rational> exact = Rational(1);  // the factor, where it is a fraction
  Dimension dimension;
  double offset = 0.0;  // of degC alone
  bool hertz = false;   // counts cycles a second: not to be taken for rad/s

  bool si() const { return factor == 1.0 && offset == 0.0; }
};

/// The unit that `text` as a whole names: names with SI prefixes, `*`, `/`, `^` and parentheses, or "1".
/// Throws TextError.
Unit parse_unit(std::string_view text);

/// The unit at `at` of an expression, after a number; moves `at` behind it. It ends before the first name for
/// which `ends_at` holds, and before everything that cannot belong to a unit. Nothing when there is no unit
/// at `at`. Throws TextError.
std::optional<Unit> parse_unit_in(std::string_view text, std::size_t& at,
                                  const std::function<bool(std::string_view)>& ends_at);

/// All names without prefixes, for suggestions.
const std::vector<std::string>& unit_names();

/// The declared unit "any" has no dimension.
std::optional<Dimension> declared_dimension(const std::string& unit);

/// Products and powers. Nothing when an exponent leaves the range of Dimension.
std::optional<Dimension> multiply(const Dimension& a, const Dimension& b);
std::optional<Dimension> divide(const Dimension& a, const Dimension& b);
/// a^exponent; nothing when an exponent is no whole number.
std::optional<Dimension> power(const Dimension& a, const Rational& exponent);

/// "V" where the unit has a name, else "kg*m^2/s"; "1" for a number. A torque shows as "J".
std::string to_string(const Dimension& dimension);

}  // namespace flyball
