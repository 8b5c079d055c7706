#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "blocks/dimension.h"
#include "blocks/rational.h"
#include "blocks/scalar.h"

namespace flyball {

/// A parsed expression, evaluated on any scalar. `min`, `max`, `abs` and `sign` are written with `choose` and
/// `greater` by the parser, so that every kink is a comparison that the engine can locate.
struct Formula {
  enum class Op : std::uint8_t {
    // values
    literal,  // value
    operand,  // index into operands
    add,
    subtract,
    multiply,
    divide,
    power,
    negate,
    sin,
    cos,
    tan,
    asin,
    acos,
    atan,
    atan2,
    sinh,
    cosh,
    tanh,
    exp,
    log,
    log10,
    sqrt,
    hypot,
    choose,  // arguments: condition, value if it holds, value if not
    // conditions
    greater,  // arguments a, b: a > b; comparison number in `index`
    both,
    either,
    opposite
  };

  struct Node {
    Op op = Op::literal;
    int offset = 0;                           // where it stands in the text, from 0
    int index = 0;                            // number of the operand, comparison or literal
    double value = 0.0;                       // literal, SI
    std::optional<Rational> exact;            // literal as an exact fraction, where its text and unit allow
    std::optional<Dimension> dimension;       // literal that was written with a unit
    bool hertz = false;                       // literal that counts cycles a second, not radians
    std::array<int, 3> argument{-1, -1, -1};  // nodes
  };

  std::string text;
  std::vector<Node> nodes;            // an argument stands before its user; the last node is the result
  std::vector<std::string> operands;  // names, in order of first use
  int comparisons = 0;

  /// `operand(i)` gives the value of operand i, `compare(k, a, b)` decides whether a > b in comparison k.
  template <class T>
  T evaluate(auto&& operand, auto&& compare) const {
    return value<T>(static_cast<int>(nodes.size()) - 1, operand, compare);
  }

  /// Numbers the literals from `first` on, and gives the number behind the last.
  int number_literals(int first);
  /// The unknown of Dimensional that literal k is: literals count downwards, below the base units.
  static int literal_unknown(int k) { return -1 - k; }

 private:
  template <class T>
  static T literal(const Node& node) {
    if constexpr (std::is_same_v<T, Dimensional>) {
      return Dimensional::literal(node.value, literal_unknown(node.index), node.dimension.has_value());
    } else {
      return T(node.value);
    }
  }
  template <class T>
  T value(int at, auto& operand, auto& compare) const;
  template <class T>
  Bit<T> condition(int at, auto& operand, auto& compare) const;
};

inline int Formula::number_literals(int first) {
  for (Node& node : nodes) {
    if (node.op == Op::literal) node.index = first++;
  }
  return first;
}

template <class T>
T Formula::value(int at, auto& operand, auto& compare) const {
  const Node& node = nodes[at];
  const auto arg = [&](int k) { return value<T>(node.argument[k], operand, compare); };
  switch (node.op) {
    case Op::literal:
      return literal<T>(node);
    case Op::operand:
      return operand(node.index);
    case Op::add:
      return arg(0) + arg(1);
    case Op::subtract:
      return arg(0) - arg(1);
    case Op::multiply:
      return arg(0) * arg(1);
    case Op::divide:
      return arg(0) / arg(1);
    case Op::power: {
      // A literal exponent keeps integer powers exact and lets the base be negative.
      const Node& exponent = nodes[node.argument[1]];
      if (exponent.op == Op::literal) return pow(arg(0), exponent.value);
      return pow(arg(0), arg(1));
    }
    case Op::negate:
      return -arg(0);
    case Op::sin:
      return sin(arg(0));
    case Op::cos:
      return cos(arg(0));
    case Op::tan:
      return tan(arg(0));
    case Op::asin:
      return asin(arg(0));
    case Op::acos:
      return acos(arg(0));
    case Op::atan:
      return atan(arg(0));
    case Op::atan2:
      return atan2(arg(0), arg(1));
    case Op::sinh:
      return sinh(arg(0));
    case Op::cosh:
      return cosh(arg(0));
    case Op::tanh:
      return tanh(arg(0));
    case Op::exp:
      return exp(arg(0));
    case Op::log:
      return log(arg(0));
    case Op::log10:
      return log10(arg(0));
    case Op::sqrt:
      return sqrt(arg(0));
    case Op::hypot:
      return hypot(arg(0), arg(1));
    case Op::choose: {
      const Bit<T> holds = condition<T>(node.argument[0], operand, compare);
      return select(holds, arg(1), arg(2));
    }
    default:
      return T(0.0);  // conditions have no value; the parser keeps them apart
  }
}

template <class T>
Bit<T> Formula::condition(int at, auto& operand, auto& compare) const {
  const Node& node = nodes[at];
  const auto arg = [&](int k) { return condition<T>(node.argument[k], operand, compare); };
  switch (node.op) {
    case Op::both:
      return both(arg(0), arg(1));
    case Op::either:
      return either(arg(0), arg(1));
    case Op::opposite:
      return opposite(arg(0));
    default: {
      const T a = value<T>(node.argument[0], operand, compare);
      const T b = value<T>(node.argument[1], operand, compare);
      return compare(node.index, a, b);
    }
  }
}

}  // namespace flyball
