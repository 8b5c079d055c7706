#pragma once
#include "blocks/block.h"

namespace flyball {

struct RelationalOperator : Block {
  static constexpr auto summary = "Compares its inputs: 1 when the comparison holds, else 0.";
  static constexpr std::array aliases{"RELATIONALOP"};
  // In the order of `choices`.
  enum class Comparison { equal, different, less, less_equal, greater_equal, greater };
  Comparison comparison = static_cast<Comparison>(
      option("operator", "<=", {"==", "~=", "<", "<=", ">=", ">"}, "how u1 compares with u2"));
  Input u1 = input("u1", "any", "left side");
  Input u2 = input("u2", "any", "right side");
  Output y = output("y", "1", "1 when the comparison holds, else 0");
  Relation holds = relation("holds", "the comparison holds");

  // The least positive number makes each side of a relation at which equal numbers belong: unequal ones
  // differ by more.
  void relations(auto& v) const {
    const auto excess = v[u1] - v[u2];
    switch (comparison) {
      case Comparison::equal:
        v[holds] = smallest - abs(excess);
        break;
      case Comparison::different:
        v[holds] = abs(excess) - smallest;
        break;
      case Comparison::less:
        v[holds] = -excess - smallest;
        break;
      case Comparison::less_equal:
        v[holds] = smallest - excess;
        break;
      case Comparison::greater_equal:
        v[holds] = excess + smallest;
        break;
      case Comparison::greater:
        v[holds] = excess - smallest;
        break;
    }
  }
  void outputs(auto& v) const { v[y] = select(v.on(holds), v.number(1.0), v.number(0.0)); }
};

}  // namespace flyball
