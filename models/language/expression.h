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

/// Functions that an expression may call besides those of the language, such as measures of a run.
class Calls {
 public:
  virtual ~Calls() = default;
  /// Reads the call of `name` from its first argument at `at` to behind its closing parenthesis, and gives
  /// the name of the operand that stands for its value. Nothing, and `at` not moved, when it has no such
  /// function. Throws TextError.
  virtual std::optional<std::string> read(std::string_view name, std::string_view text, std::size_t& at) = 0;
  /// For suggestions.
  virtual std::vector<std::string> names() const = 0;
};

/// The names that an expression may use besides functions and the constants pi and e.
struct Scope {
  const NameIndex* parameters = nullptr;
  std::span<const std::string> inputs;
  const Scope* outer = nullptr;  // whose names are seen, too
  Calls* calls = nullptr;
  /// The names are those of signals: they may have dots, and behind a number a unit comes before them.
  bool of_signals = false;

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

enum class Wanted { number, condition };

/// Parses from `at` as far as the text goes on as a number without comparisons, or as a condition, and moves
/// `at` behind it. A condition becomes a number: 1 where it holds, else 0. Offsets of errors count from the
/// start of the text. Throws TextError.
Formula parse_part(std::string_view text, std::size_t& at, const Scope& scope,
                   Wanted wanted = Wanted::number);

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
