#include "models/language/quantity.h"

#include <cmath>

#include "models/language/messages.h"

namespace flyball {
namespace {

using Op = Formula::Op;
using Kind = Quantity::Kind;

class Inference {
 public:
  Inference(const Formula& formula, std::span<const Quantity> operands)
      : formula_(formula), operands_(operands) {}

  Quantity result() {
    for (const Formula::Node& node : formula_.nodes) found_.push_back(quantity(node));
    return found_.back();
  }

 private:
  const Quantity& argument(const Formula::Node& node, int k) const { return found_[node.argument[k]]; }

  Quantity quantity(const Formula::Node& node) const {
    switch (node.op) {
      case Op::literal:
        return literal(node);
      case Op::operand:
        return operands_[node.index];
      case Op::negate:
        return argument(node, 0);
      case Op::add:
      case Op::subtract:
      case Op::greater:
      case Op::hypot:
        return same(node, argument(node, 0), argument(node, 1));
      case Op::choose:
        return same(node, argument(node, 1), argument(node, 2));
      case Op::multiply:
      case Op::divide:
        return product(node);
      case Op::power:
        return power_of(node);
      case Op::sqrt:
        return scaled(argument(node, 0), *Rational::fraction(1, 2));
      case Op::atan2:
        same(node, argument(node, 0), argument(node, 1));
        return Kind::free;
      case Op::both:
      case Op::either:
      case Op::opposite:
        return Kind::free;
      default:
        return function_of_number(node);
    }
  }

  static Quantity literal(const Formula::Node& node) {
    Quantity result(node.dimension ? Kind::known : Kind::free);
    if (node.dimension) result.dimension = *node.dimension;
    result.hertz = node.hertz;
    result.turns = node.value == M_PI || node.value == 2 * M_PI;
    return result;
  }

  static Quantity same(const Formula::Node& node, const Quantity& a, const Quantity& b) {
    if (a.known() && b.known() && a.dimension != b.dimension) {
      throw TextError(node.offset, message::unequal_dimensions(a.dimension, b.dimension));
    }
    Quantity result = a.known() ? a : b.known() ? b : a.kind == Kind::unknown ? a : b;
    result.hertz = a.hertz || b.hertz;
    return result;
  }

  Quantity product(const Formula::Node& node) const {
    const Quantity& a = argument(node, 0);
    const Quantity& b = argument(node, 1);
    Quantity result;
    result.turns = a.turns || b.turns;
    const bool cycles = a.hertz || (node.op == Op::multiply && b.hertz);
    result.hertz = cycles && !result.turns;
    if (a.kind == Kind::unknown || b.kind == Kind::unknown) return result;
    if (a.kind == Kind::free && b.kind == Kind::free) return result.kind = Kind::free, result;
    const auto dimension =
        node.op == Op::multiply ? multiply(a.dimension, b.dimension) : divide(a.dimension, b.dimension);
    if (!dimension) throw TextError(node.offset, message::exponent_too_large());
    result.kind = Kind::known;
    result.dimension = *dimension;
    return result;
  }

  static Quantity scaled(const Quantity& base, const Rational& exponent) {
    if (!base.known()) return base.kind;
    const auto dimension = power(base.dimension, exponent);
    // A root that has no whole exponents may still be a factor of something that has.
    Quantity result(dimension ? Kind::known : Kind::unknown);
    if (dimension) result.dimension = *dimension;
    return result;
  }

  Quantity power_of(const Formula::Node& node) const {
    const Formula::Node& exponent = formula_.nodes[node.argument[1]];
    expect_number(argument(node, 1), exponent.offset);
    if (exponent.op == Op::literal && exponent.exact) return scaled(argument(node, 0), *exponent.exact);
    const Quantity& base = argument(node, 0);
    return base.kind == Kind::free ? base : Quantity();
  }

  static void expect_number(const Quantity& argument, int offset) {
    if (argument.known() && argument.dimension != Dimension{}) {
      throw TextError(offset, message::expected_plain_number(argument.dimension));
    }
  }

  Quantity function_of_number(const Formula::Node& node) const {
    expect_number(argument(node, 0), formula_.nodes[node.argument[0]].offset);
    return Kind::free;
  }

  const Formula& formula_;
  std::span<const Quantity> operands_;
  std::vector<Quantity> found_;
};

}  // namespace

Quantity::Quantity(const std::string& unit) {
  const auto declared = declared_dimension(unit);
  if (!declared) return;
  kind = Kind::known;
  dimension = *declared;
  hertz = parse_unit(unit).hertz;
}

Quantity infer(const Formula& formula, std::span<const Quantity> operands) {
  return Inference(formula, operands).result();
}

std::optional<std::string> misfit(const Quantity& value, const std::string& unit) {
  const auto dimension = declared_dimension(unit);
  if (!dimension || !value.known()) return std::nullopt;
  if (value.dimension != *dimension) return message::wrong_dimension(unit, *dimension, value.dimension);
  if (value.hertz && unit.starts_with("rad")) return message::hertz_for_radians(unit);
  return std::nullopt;
}

}  // namespace flyball
