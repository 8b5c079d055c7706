#include "models/language/literal.h"

#include <cctype>
#include <charconv>
#include <cmath>

#include "models/language/expression.h"
#include "models/language/messages.h"
#include "models/language/units.h"

namespace flyball {
namespace {

struct Number {
  double value = 0.0;
  std::optional<Rational> exact;
};

bool digit_at(std::string_view text, std::size_t at) {
  return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0;
}

std::size_t skip_space(std::string_view text, std::size_t at) {
  return std::min(text.find_first_not_of(" \t\r\n", at), text.size());
}

Number digits(std::string_view text, std::size_t& at) {
  Number result;
  const std::size_t first = at;
  const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), result.value);
  if (error == std::errc::invalid_argument)
    throw TextError(first, message::unexpected(first_character(text.substr(first))));
  if (error != std::errc()) throw TextError(first, message::number_out_of_reach());
  at = static_cast<std::size_t>(end - text.data());
  result.exact = exact_decimal(text.substr(first, at - first));
  return result;
}

std::optional<Unit> unit_behind(std::string_view text, std::size_t& at, const EndsUnit& ends_unit) {
  std::size_t behind = skip_space(text, at);
  const auto unit = parse_unit_in(text, behind, ends_unit);
  if (unit) at = behind;
  return unit;
}

/// "/3 s" behind "1": moves `at` and divides where a plain number with a unit follows.
std::optional<Unit> divisor_behind(std::string_view text, std::size_t& at, Number& number,
                                   const EndsUnit& ends_unit) {
  std::size_t behind = skip_space(text, at);
  if (behind == text.size() || text[behind] != '/') return std::nullopt;
  behind = skip_space(text, behind + 1);
  if (!digit_at(text, behind)) return std::nullopt;
  const Number divisor = digits(text, behind);
  const auto unit = unit_behind(text, behind, ends_unit);
  if (!unit) return std::nullopt;
  at = behind;
  number.exact = number.exact && divisor.exact ? divide(*number.exact, *divisor.exact) : std::nullopt;
  number.value /= divisor.value;
  return unit;
}

Formula::Node in_unit(const Number& number, const Unit& unit) {
  Formula::Node node;
  node.value = number.value * unit.factor;
  node.exact = number.exact && unit.exact ? multiply(*number.exact, *unit.exact) : std::nullopt;
  // Rounded once: "54 mm" is the double nearest to 0.054.
  constexpr std::int64_t exact_in_double = std::int64_t{1} << 53;
  if (node.exact && std::abs(node.exact->numerator()) <= exact_in_double &&
      node.exact->denominator() <= exact_in_double) {
    node.value = node.exact->value();
  }
  node.dimension = unit.dimension;
  node.hertz = unit.hertz;
  return node;
}

/// The name of a unit may hold letters that no other name holds: the micro sign, Greek mu and omega, ohm
/// sign.
std::string_view leading_unit_name(std::string_view text) {
  std::size_t end = 0;
  while (true) {
    const std::string_view rest = text.substr(end), letter = first_character(rest);
    const bool of_units =
        letter == "\u00B5" || letter == "\u03BC" || letter == "\u03A9" || letter == "\u2126";
    const std::size_t length = of_units ? letter.size() : leading_name(rest).size();
    if (length == 0) return text.substr(0, end);
    end += length;
  }
}

/// "3 mmm", "12 V" with a parameter V: after a number, a name that is no unit.
void refuse_name(std::string_view text, std::size_t first, std::size_t at, const EndsUnit& ends_unit) {
  const std::size_t start = skip_space(text, at);
  const std::string_view name = leading_unit_name(text.substr(start));
  if (name.empty() || is_reserved(name)) return;
  const std::size_t behind = skip_space(text, start + name.size());
  if (behind < text.size() && text[behind] == '(') {
    throw TextError(start, message::unexpected(std::string(name) + "("));
  }
  throw TextError(start, ends_unit(name)
                             ? message::parameter_after_number(text.substr(first, at - first), name)
                             : message::unknown_unit(name));
}

}  // namespace

Formula::Node parse_literal(std::string_view text, std::size_t& at, bool fraction,
                            const EndsUnit& ends_unit) {
  const std::size_t first = at;
  Number number = digits(text, at);
  auto unit = unit_behind(text, at, ends_unit);
  if (!unit && fraction) unit = divisor_behind(text, at, number, ends_unit);
  if (unit && unit->offset != 0.0) throw TextError(first, message::celsius_in_compound());
  refuse_name(text, first, at, ends_unit);
  Formula::Node node;
  if (unit) node = in_unit(number, *unit);
  if (!unit) node.value = number.value;
  if (!unit) node.exact = number.exact;
  node.offset = static_cast<int>(first);
  return node;
}

std::optional<Formula::Node> parse_celsius(std::string_view text) {
  constexpr std::string_view unit = "degC";
  const std::size_t first = skip_space(text, 0);
  const std::size_t last = text.find_last_not_of(" \t\r\n");
  if (last == std::string_view::npos || !text.substr(0, last + 1).ends_with(unit)) return std::nullopt;
  const std::size_t sign = first < text.size() && text[first] == '+' ? first + 1 : first;
  Formula::Node node;
  const char* unit_starts = text.data() + last + 1 - unit.size();
  const auto [end, error] = std::from_chars(text.data() + sign, unit_starts, node.value);
  if (error != std::errc()) return std::nullopt;
  if (skip_space(text, static_cast<std::size_t>(end - text.data())) != last + 1 - unit.size())
    return std::nullopt;
  node.value += parse_unit(unit).offset;
  node.offset = static_cast<int>(first);
  node.dimension = parse_unit(unit).dimension;
  return node;
}

}  // namespace flyball
