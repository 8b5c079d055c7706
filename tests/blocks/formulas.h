#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "blocks/formula.h"

namespace flyball::test {

/// Builds formulas node by node, so that the tests of blocks need no parser.
class FormulaBuilder {
 public:
  using Op = Formula::Op;

  int literal(double value) {
    Formula::Node node;
    node.value = value;
    return push(node);
  }
  int name(const std::string& operand) {
    auto& names = formula_.operands;
    const auto found = std::ranges::find(names, operand);
    Formula::Node node;
    node.op = Op::operand;
    node.index = static_cast<int>(found - names.begin());
    if (found == names.end()) names.push_back(operand);
    return push(node);
  }
  int apply(Op op, int a, int b = -1, int c = -1) {
    Formula::Node node;
    node.op = op;
    node.argument = {a, b, c};
    if (op == Op::greater) node.index = formula_.comparisons++;
    return push(node);
  }
  /// The last node built is the result.
  std::shared_ptr<const Formula> finish(std::string text) {
    formula_.text = std::move(text);
    return std::make_shared<const Formula>(formula_);
  }

 private:
  int push(const Formula::Node& node) {
    formula_.nodes.push_back(node);
    return static_cast<int>(formula_.nodes.size()) - 1;
  }

  Formula formula_;
};

/// max(u, w) + gain * sin(u)^2
inline std::shared_ptr<const Formula> example_formula() {
  using Op = Formula::Op;
  FormulaBuilder f;
  const int u = f.name("u"), w = f.name("w");
  const int larger = f.apply(Op::choose, f.apply(Op::greater, u, w), u, w);
  const int square = f.apply(Op::power, f.apply(Op::sin, u), f.literal(2.0));
  f.apply(Op::add, larger, f.apply(Op::multiply, f.name("gain"), square));
  return f.finish("max(u, w) + gain*sin(u)^2");
}

/// if (u > w and not (w > 1)) or u > 2: u*w, else: if u > w: -u, else: w/2
inline std::shared_ptr<const Formula> branching_formula() {
  using Op = Formula::Op;
  FormulaBuilder f;
  const int u = f.name("u"), w = f.name("w");
  const int first = f.apply(Op::both, f.apply(Op::greater, u, w),
                            f.apply(Op::opposite, f.apply(Op::greater, w, f.literal(1.0))));
  const int condition = f.apply(Op::either, first, f.apply(Op::greater, u, f.literal(2.0)));
  const int inner = f.apply(Op::choose, f.apply(Op::greater, u, w), f.apply(Op::negate, u),
                            f.apply(Op::divide, w, f.literal(2.0)));
  f.apply(Op::choose, condition, f.apply(Op::multiply, u, w), inner);
  return f.finish("if((u > w and not w > 1) or u > 2, u*w, if(u > w, -u, w/2))");
}

}  // namespace flyball::test
