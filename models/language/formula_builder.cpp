#include "models/language/formula_builder.h"

#include <algorithm>

#include "models/language/expression.h"
#include "models/language/messages.h"

namespace flyball {
namespace {

using Op = Formula::Op;

// A value is computed recursively: about 300 bytes of stack a level on the widest scalar.
constexpr int deepest = 2000;
constexpr int most_expensive = 100'000;

}  // namespace

int FormulaBuilder::push(Formula::Node node) {
  int depth = 0;
  int cost = 1;
  for (const int argument : node.argument) {
    if (argument < 0) continue;
    depth = std::max(depth, depth_[argument]);
    cost += cost_[argument];
  }
  if (depth >= deepest) throw TextError(node.offset, message::expression_too_deep());
  if (cost > most_expensive) throw TextError(node.offset, message::expression_too_long());
  depth_.push_back(depth + 1);
  cost_.push_back(cost);
  formula_.nodes.push_back(std::move(node));
  return static_cast<int>(formula_.nodes.size()) - 1;
}

int FormulaBuilder::literal(Formula::Node node) {
  node.op = Op::literal;
  return push(std::move(node));
}

int FormulaBuilder::operand(std::string_view name, std::size_t offset) {
  const auto found = std::ranges::find(formula_.operands, name);
  Formula::Node node;
  node.op = Op::operand;
  node.offset = static_cast<int>(offset);
  node.index = static_cast<int>(found - formula_.operands.begin());
  if (found == formula_.operands.end()) formula_.operands.emplace_back(name);
  return push(std::move(node));
}

int FormulaBuilder::add(Op op, std::size_t offset, int a, int b, int c) {
  Formula::Node node;
  node.op = op;
  node.offset = static_cast<int>(offset);
  node.argument = {a, b, c};
  return push(std::move(node));
}

int FormulaBuilder::greater(std::size_t offset, int a, int b) {
  const int at = add(Op::greater, offset, a, b);
  formula_.nodes[at].index = formula_.comparisons++;
  return at;
}

int FormulaBuilder::negative(std::size_t offset, int a) {
  // Only a literal that was just read: nothing else can refer to it.
  if (node(a).op != Op::literal || a + 1 != static_cast<int>(formula_.nodes.size()))
    return add(Op::negate, offset, a);
  Formula::Node& number = formula_.nodes[a];
  number.value = -number.value;
  if (number.exact) number.exact = subtract(Rational(0), *number.exact);
  number.offset = static_cast<int>(offset);
  return a;
}

bool FormulaBuilder::constant(int at) const {
  const Formula::Node& n = node(at);
  if (n.op == Op::operand || n.op >= Op::choose || n.dimension) return false;
  return std::ranges::all_of(n.argument, [&](int argument) { return argument < 0 || constant(argument); });
}

int FormulaBuilder::power(std::size_t offset, int a, int b) {
  if (node(b).op == Op::literal || !constant(b)) return add(Op::power, offset, a, b);
  // The nodes behind the base are the exponent's.
  Formula exponent;
  for (int at = a + 1; at <= b; ++at) {
    exponent.nodes.push_back(node(at));
    for (int& argument : exponent.nodes.back().argument) argument -= a + 1;
  }
  Formula::Node folded;
  folded.offset = node(b).offset;
  folded.value = evaluate(exponent, {});
  folded.exact = evaluate_exact(exponent, {});
  const auto kept = static_cast<std::size_t>(a) + 1;
  formula_.nodes.resize(kept);
  depth_.resize(kept);
  cost_.resize(kept);
  return add(Op::power, offset, a, literal(std::move(folded)));
}

}  // namespace flyball
