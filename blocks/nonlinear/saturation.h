#pragma once
#include "blocks/block.h"

namespace flyball {

struct Saturation : Block {
  static constexpr auto summary = "Limits its input.";
  static constexpr std::array aliases{"Modelica.Blocks.Nonlinear.Limiter", "SATURATION", "SAT_f"};
  Param lower = param("lower", -1.0, "any", any, "lower limit");
  Param upper = param("upper", 1.0, "any", any, "upper limit");
  Input u = input("u", "any", "signal");
  Output y = output("y", "any", "limited signal");
  Relation above = relation("above", "the signal exceeds the upper limit");
  Relation below = relation("below", "the signal is under the lower limit");

  void relations(auto& v) const {
    v[above] = v[u] - v[upper];
    v[below] = v[lower] - v[u];
  }
  void outputs(auto& v) const { v[y] = select(v.on(above), v[upper], select(v.on(below), v[lower], v[u])); }
};

}  // namespace flyball
