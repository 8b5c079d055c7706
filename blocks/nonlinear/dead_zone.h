#pragma once
#include "blocks/block.h"

namespace flyball {

struct DeadZone : Block {
  static constexpr auto summary = "Zero inside a zone, and the distance from the zone outside of it.";
  static constexpr std::array aliases{"Modelica.Blocks.Nonlinear.DeadZone", "DEADBAND"};
  Param lower = param("lower", -0.5, "any", any, "lower end of the zone");
  Param upper = param("upper", 0.5, "any", any, "upper end of the zone");
  Input u = input("u", "any", "signal");
  Output y = output("y", "any", "how far the signal is outside of the zone");
  Relation above = relation("above", "the signal is above the zone");
  Relation below = relation("below", "the signal is below the zone");

  void relations(auto& v) const {
    v[above] = v[u] - v[upper];
    v[below] = v[lower] - v[u];
  }
  void outputs(auto& v) const {
    v[y] = select(v.on(above), v[u] - v[upper], select(v.on(below), v[u] - v[lower], v.number(0.0)));
  }
};

}  // namespace flyball
