#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "blocks/formula.h"
#include "models/language/names.h"
#include "models/language/text_error.h"

namespace flyball {

/// The names that an expression may use besides functions and the constants pi and e.
struct Scope {
  const NameIndex* parameters = nullptr;
  std::span<const std::string> inputs;
  const Scope* outer = nullptr;  // whose names are seen, too

  bool knows(std::string_view name) const;
  /// All of them in alphabetical order, for suggestions.
  std::vector<std::string> names() const;
};

/// Parses an expression. By rising strength: or; and; not; < <= > >=; + -; * /; unary + -; ^ (from the
/// right). A number takes the unit behind it ("54 mm", "2 kg*m^2"); so does a fraction of two numbers at the
/// start of a term
/// ("1/3 s"). A unit ends before a name of the scope: with a parameter V, "2 m*V" is 2 m times V.
/// Throws TextError.
Formula parse_expression(std::string_view text, const Scope& scope);

/// The value in SI, comparisons decided by value.
double evaluate(const Formula& formula, std::span<const double> operands);

/// The value as an exact fraction. Nothing where a literal or an operand has none, a function is used, or the
/// result does not fit.
std::optional<Rational> evaluate_exact(const Formula& formula,
                                       std::span<const std::optional<Rational>> operands);

/// A decimal number ("12", "0.5e-3") as a fraction; nothing when it does not fit.
std::optional<Rational> exact_decimal(std::string_view text);

/// The functions that an expression may call, by name, for suggestions.
const std::vector<std::string>& function_names();

/// Words with a meaning of their own, which name no parameter: and, or, not, if.
bool is_reserved(std::string_view name);

}  // namespace flyball
