#include "models/language/expression.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

using Op = Formula::Op;
using Exact = std::optional<Rational>;

Exact exact_power(const Rational& base, const Rational& exponent) {
  // A larger one would not fit, whatever the base, except for 0 and 1.
  constexpr int largest = 64;
  if (exponent.denominator() != 1 || std::abs(exponent.numerator()) > largest) return std::nullopt;
  Exact result(1);
  for (int k = 0; k < std::abs(exponent.numerator()) && result; ++k) {
    result = exponent.numerator() > 0 ? multiply(*result, base) : divide(*result, base);
  }
  return result;
}

Exact exact_arithmetic(Op op, const Rational& a, const Rational& b) {
  switch (op) {
    case Op::add:
      return add(a, b);
    case Op::subtract:
      return subtract(a, b);
    case Op::multiply:
      return multiply(a, b);
    case Op::divide:
      return divide(a, b);
    case Op::power:
      return exact_power(a, b);
    default:
      return std::nullopt;
  }
}

/// Values of all nodes in order; a condition is 1 or 0.
class ExactEvaluation {
 public:
  ExactEvaluation(const Formula& formula, std::span<const Exact> operands)
      : formula_(formula), operands_(operands) {}

  Exact result() {
    for (const Formula::Node& node : formula_.nodes) values_.push_back(value(node));
    return values_.back();
  }

 private:
  Exact value(const Formula::Node& node) const {
    if (node.op == Op::literal) return node.exact;
    if (node.op == Op::operand) return operands_[node.index];
    const Exact a = argument(node, 0);
    if (!a) return std::nullopt;
    if (node.op == Op::negate) return subtract(Rational(0), *a);
    if (node.op == Op::opposite) return Rational(a->numerator() == 0 ? 1 : 0);
    if (node.op == Op::choose) return argument(node, a->numerator() != 0 ? 1 : 2);
    const Exact b = argument(node, 1);
    if (!b) return std::nullopt;
    if (node.op == Op::both) return multiply(*a, *b);
    if (node.op == Op::either) return Rational(a->numerator() != 0 || b->numerator() != 0 ? 1 : 0);
    if (node.op != Op::greater) return exact_arithmetic(node.op, *a, *b);
    const Exact difference = subtract(*a, *b);
    return difference ? Exact(difference->numerator() > 0 ? 1 : 0) : std::nullopt;
  }

  Exact argument(const Formula::Node& node, int k) const {
    return node.argument[k] < 0 ? std::nullopt : values_[node.argument[k]];
  }

  const Formula& formula_;
  std::span<const Exact> operands_;
  std::vector<Exact> values_;
};

}  // namespace

bool Scope::knows(std::string_view name) const {
  return (parameters != nullptr && parameters->contains(name)) ||
         std::ranges::find(inputs, name) != inputs.end() || (outer != nullptr && outer->knows(name));
}

std::vector<std::string> Scope::names() const {
  std::vector<std::string> all;
  for (const Scope* scope = this; scope != nullptr; scope = scope->outer) {
    all.insert(all.end(), scope->inputs.begin(), scope->inputs.end());
    if (scope->parameters == nullptr) continue;
    for (const auto& [name, index] : *scope->parameters) all.push_back(name);
  }
  std::ranges::sort(all);
  return all;
}

bool is_reserved(std::string_view name) {
  return name == "and" || name == "or" || name == "not" || name == "if";
}

double evaluate(const Formula& formula, std::span<const double> operands) {
  return formula.evaluate<double>([&](int k) { return operands[k]; },
                                  [](int, double a, double b) { return a > b; });
}

std::optional<Rational> evaluate_exact(const Formula& formula,
                                       std::span<const std::optional<Rational>> operands) {
  return ExactEvaluation(formula, operands).result();
}

std::optional<Rational> exact_decimal(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  const std::size_t end = std::min(text.find_first_of("eE"), text.size());
  long exponent = end < text.size() ? std::strtol(std::string(text.substr(end + 1)).c_str(), nullptr, 10) : 0;
  Exact mantissa(0);
  bool fraction = false;
  for (const char c : text.substr(0, end)) {
    if (c == '.') {
      fraction = true;
      continue;
    }
    if (c < '0' || c > '9') return std::nullopt;
    mantissa = mantissa ? multiply(*mantissa, 10) : std::nullopt;
    mantissa = mantissa ? add(*mantissa, c - '0') : std::nullopt;
    if (fraction) --exponent;
  }
  if (!mantissa || mantissa->numerator() == 0) return mantissa;
  const Exact scale = exact_power(Rational(10), Rational(exponent));
  const Exact size = scale ? multiply(*mantissa, *scale) : std::nullopt;
  return size && negative ? subtract(Rational(0), *size) : size;
}

}  // namespace flyball
