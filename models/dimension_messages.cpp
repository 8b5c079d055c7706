#include "models/dimension_messages.h"

#include <fmt/format.h>

#include <array>
#include <cstdlib>

#include "models/language/units.h"

namespace flyball::message {
namespace {

using fmt::format;
using Text = std::string_view;

/// Nothing when an exponent is broken or out of reach.
std::optional<Dimension> whole(const LinearForm& unit) {
  Dimension result;
  for (const auto& [base, exponent] : unit.terms()) {
    if (exponent.denominator() != 1 || std::abs(exponent.numerator()) > 127) return std::nullopt;
    result.exponent[base] = static_cast<std::int8_t>(exponent.numerator());
  }
  return result;
}

std::string unit_of(const LinearForm* unit) { return unit == nullptr ? "" : " in " + unit_text(*unit); }

}  // namespace

std::string unit_text(const LinearForm& unit) {
  if (const auto dimension = whole(unit)) return to_string(*dimension);
  std::string text;
  for (const auto& [base, exponent] : unit.terms()) {
    Dimension one;
    one.exponent[base] = 1;
    text += format("{}{}", text.empty() ? "" : "*", to_string(one));
    if (exponent == Rational(1)) continue;
    text += exponent.denominator() == 1 ? format("^{}", exponent.numerator())
                                        : format("^({}/{})", exponent.numerator(), exponent.denominator());
  }
  return text;
}

std::string in_unit(const LinearForm& unit) {
  return unit.zero() ? "a plain number" : "in " + unit_text(unit);
}

std::string unit_contradicts(Text name, const LinearForm& unit, const LinearForm& needed, bool settles) {
  return format("{} is {}, but {} it {}", name, in_unit(unit),
                settles ? "the diagram needs" : "these equations need",
                needed.zero() ? "as a plain number" : in_unit(needed));
}
std::string override_contradicts(Text name, const LinearForm& unit, const LinearForm& needed) {
  const auto kind = [](const LinearForm& form) { return form.zero() ? "a plain number" : unit_text(form); };
  return format("--set {}: expected {}, found {}", name, kind(needed), kind(unit));
}
std::string would_settle(Text name, const LinearForm& needed) {
  return format("{} {} would settle the diagram, too", name,
                needed.zero() ? "as a plain number" : in_unit(needed));
}
std::string would_have_to_be(Text name, const LinearForm& needed) {
  return format("{} would have to be {} for these equations", name, in_unit(needed));
}

std::string is_in_unit(Text name, const LinearForm& unit) { return format("{} is {}", name, in_unit(unit)); }
std::string is_declared_in(Text name, const LinearForm& unit) {
  return unit.zero() ? format("{} is declared as a plain number", name)
                     : format("{} is declared in {}", name, unit_text(unit));
}
std::string wants_number(Text block, Text argument) {
  return format("{} wants a plain number as {}", block, argument);
}
std::string follows(Text equation, Text name, const LinearForm& unit) {
  return format("{}, so {} is {}", equation, name, in_unit(unit));
}
std::string does_not_fit(Text equation) { return format("but {}", equation); }

std::string hidden_in_literal(Text literal, const LinearForm* unit) {
  return format("{} hides a factor{}: as a plain number it contradicts the other equations", literal,
                unit_of(unit));
}
std::string hidden_in_rate(Text state, const LinearForm* unit) {
  return format("the rate of {} hides a factor{}: it cannot be {}/s", state, unit_of(unit), state);
}
std::string hidden_before(Text equation) { return format("a factor with a unit is hidden: {}", equation); }

}  // namespace flyball::message
