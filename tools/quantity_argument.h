#pragma once

#include <string>

#include "blocks/rational.h"

namespace flyball {

/// The value in SI of a number or an expression with units ("250 ms") that is wanted in `unit`. Throws
/// UsageError.
double parse_quantity(const std::string& text, const std::string& unit);
/// The same where it must be above 0.
double parse_positive(const std::string& text, const std::string& unit);
/// The same as an exact fraction.
Rational parse_positive_exact(const std::string& text, const std::string& unit);

}  // namespace flyball
