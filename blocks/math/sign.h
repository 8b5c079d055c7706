#pragma once
#include "blocks/block.h"

namespace flyball {

struct Sign : Block {
  static constexpr auto summary = "1 for a positive signal, -1 for a negative one.";
  static constexpr std::array aliases{"Modelica.Blocks.Math.Sign", "SIGNUM"};
  Input u = input("u", "any", "signal");
  Output y = output("y", "1", "the sign; a signal that starts at 0 has the sign 0 until it leaves it");
  Relation positive = relation("positive", "the signal is positive");
  Relation negative = relation("negative", "the signal is negative");

  void relations(auto& v) const {
    v[positive] = v[u];
    v[negative] = -v[u];
  }
  void outputs(auto& v) const {
    v[y] = select(v.on(positive), v.number(1.0), select(v.on(negative), v.number(-1.0), v.number(0.0)));
  }
};

}  // namespace flyball
