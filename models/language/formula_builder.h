#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "blocks/formula.h"

namespace flyball {

/// Appends nodes to a formula, so that each argument stands before its user. Throws TextError where the
/// formula would become too deep to be evaluated on the stack, or too long because an argument is used
/// several times.
class FormulaBuilder {
 public:
  explicit FormulaBuilder(std::string_view text) { formula_.text = text; }

  int literal(Formula::Node node);
  int operand(std::string_view name, std::size_t offset);
  int add(Formula::Op op, std::size_t offset, int a, int b = -1, int c = -1);
  /// a > b
  int greater(std::size_t offset, int a, int b);
  /// -a; a literal stays a literal.
  int negative(std::size_t offset, int a);
  /// a^b; an exponent of unit-less literals alone becomes one literal.
  int power(std::size_t offset, int a, int b);

  const Formula::Node& node(int at) const { return formula_.nodes[at]; }
  /// The formula whose value is the node that was added last.
  Formula finish() {
    formula_.number_literals(0);
    return std::move(formula_);
  }

 private:
  int push(Formula::Node node);
  bool constant(int at) const;

  Formula formula_;
  std::vector<int> depth_;  // of the tree under each node
  std::vector<int> cost_;   // evaluations that one value of the node takes
};

}  // namespace flyball
