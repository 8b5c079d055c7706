#pragma once
#include "blocks/block.h"

namespace flyball {

struct Abs : Block {
  static constexpr auto summary = "The absolute value of its input.";
  static constexpr std::array aliases{"Modelica.Blocks.Math.Abs", "ABS_VALUE", "ABSBLK_f"};
  Input u = input("u", "any", "signal");
  Output y = output("y", "any", "absolute value of the signal");
  Relation negative = relation("negative", "the signal is negative");

  void relations(auto& v) const { v[negative] = -v[u]; }
  void outputs(auto& v) const { v[y] = select(v.on(negative), -v[u], v[u]); }
};

}  // namespace flyball
