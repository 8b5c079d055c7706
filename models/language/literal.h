#pragma once

#include <functional>
#include <string_view>

#include "blocks/formula.h"
#include "models/language/text_error.h"

namespace flyball {

/// Where a unit ends: names that mean something else in this expression.
using EndsUnit = std::function<bool(std::string_view)>;

/// The number at `at` with its unit, in SI; moves `at` behind it. With `fraction`, "1/3 s" is a third of a
/// second. Throws TextError.
Formula::Node parse_literal(std::string_view text, std::size_t& at, bool fraction, const EndsUnit& ends_unit);

/// A temperature in degrees Celsius as a whole text ("-5 degC"), in K; nothing when it is not one.
std::optional<Formula::Node> parse_celsius(std::string_view text);

}  // namespace flyball
