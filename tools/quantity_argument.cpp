#include "tools/quantity_argument.h"

#include <fmt/format.h>

#include <cmath>

#include "models/language/expression.h"
#include "models/language/quantity.h"
#include "tools/commands.h"

namespace flyball {
namespace {

Formula parse(const std::string& text, const std::string& unit) {
  try {
    Formula formula = parse_expression(text, Scope{});
    if (const auto wrong = misfit(infer(formula, {}), unit))
      throw UsageError(fmt::format("\"{}\": {}", text, *wrong));
    return formula;
  } catch (const TextError& error) {
    throw UsageError(fmt::format("\"{}\": {} (at character {})", text, error.what(), error.offset() + 1));
  }
}

double positive_value(const Formula& formula, const std::string& text, const std::string& unit) {
  const double value = evaluate(formula, {});
  if (std::isfinite(value) && value > 0.0) return value;
  throw UsageError(fmt::format("\"{}\": expected a value above 0 {}, found {}", text, unit, value));
}

}  // namespace

double parse_quantity(const std::string& text, const std::string& unit) {
  const double value = evaluate(parse(text, unit), {});
  if (!std::isfinite(value)) throw UsageError(fmt::format("\"{}\": expected a finite value", text));
  return value;
}

double parse_positive(const std::string& text, const std::string& unit) {
  return positive_value(parse(text, unit), text, unit);
}

Rational parse_positive_exact(const std::string& text, const std::string& unit) {
  const Formula formula = parse(text, unit);
  positive_value(formula, text, unit);
  if (const auto exact = evaluate_exact(formula, {})) return *exact;
  throw UsageError(fmt::format("\"{}\": expected an exact value, such as 10 ms or 1/3 s", text));
}

}  // namespace flyball
