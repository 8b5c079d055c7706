#pragma once

#include <optional>
#include <span>
#include <string>

#include "blocks/formula.h"
#include "models/language/text_error.h"
#include "models/language/units.h"

namespace flyball {

/// What is known of the dimension of a value.
struct Quantity {
  enum class Kind {
    unknown,  // uses a parameter without a unit
    free,     // numbers without units: fits whatever is wanted
    known
  };

  Quantity() = default;
  Quantity(Kind of_kind) : kind(of_kind) {}
  /// In a declared unit; unknown for "any".
  explicit Quantity(const std::string& unit);

  Kind kind = Kind::unknown;
  Dimension dimension;  // if known
  bool hertz = false;   // counts cycles a second: lacks a factor of 2 pi where rad/s is wanted
  bool turns = false;   // contains pi, which turns cycles into radians

  bool known() const { return kind == Kind::known; }
};

/// The quantity of an expression. A number without unit as a factor is a number; added, compared or selected
/// it takes the other's dimension. Throws TextError where dimensions contradict each other.
Quantity infer(const Formula& formula, std::span<const Quantity> operands);

/// What is wrong with a value where `unit` is declared; nothing when it fits.
std::optional<std::string> misfit(const Quantity& value, const std::string& unit);

}  // namespace flyball
