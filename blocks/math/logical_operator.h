#pragma once
#include "blocks/block.h"

namespace flyball {

struct LogicalOperator : Block {
  static constexpr auto summary = "A logical function of its inputs: 1 when true, else 0.";
  static constexpr std::array aliases{"LOGICAL_OP"};
  // In the order of `choices`: each odd one is the opposite of the one before.
  int function = option("operator", "AND", {"AND", "NAND", "OR", "NOR", "XOR", "NXOR", "NOT"},
                        "which; XOR is true when an odd number of inputs is");
  bool is_not = function == 6;
  int n = count("inputs", is_not ? 1 : 2, 1, 1000, "number of inputs; 1 for NOT");
  Inputs u = inputs("u", n, "any", "true when not zero");
  Output y = output("y", "1", "1 when true, else 0");
  Relations is_true = relations_each("true", n, "the input is not zero");

  explicit LogicalOperator(Settings* settings) : Block(settings) {
    if (is_not && n != 1) refuse("inputs", "expected 1 for NOT, found " + std::to_string(n));
  }

  void relations(auto& v) const {
    for (int k = 0; k < n; ++k) v[is_true[k]] = abs(v[u[k]]) - smallest;
  }
  void outputs(auto& v) const {
    auto all = v.on(is_true[0]), some = all, odd = all;
    for (int k = 1; k < n; ++k) {
      const auto next = v.on(is_true[k]);
      all = both(all, next);
      some = either(some, next);
      odd = either(both(odd, opposite(next)), both(opposite(odd), next));
    }
    const auto result = function < 2 ? all : function < 4 ? some : odd;
    v[y] = select(function % 2 == 1 || is_not ? opposite(result) : result, v.number(1.0), v.number(0.0));
  }
};

}  // namespace flyball
