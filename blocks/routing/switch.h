#pragma once
#include "blocks/block.h"

namespace flyball {

struct Switch : Block {
  static constexpr auto summary = "Passes u1 while its control exceeds a threshold, else u3.";
  static constexpr std::array aliases{"Modelica.Blocks.Logical.Switch", "SWITCH2", "SWITCH2_m"};
  Param threshold = param("threshold", 0.0, "any", any, "level that the control must exceed");
  Input u1 = input("u1", "any", "signal while the control exceeds the threshold");
  Input control = input("control", "any", "decides");
  Input u3 = input("u3", "any", "signal otherwise");
  Output y = output("y", "any", "u1 or u3");
  Relation exceeds = relation("exceeds", "the control exceeds the threshold");

  void relations(auto& v) const { v[exceeds] = v[control] - v[threshold]; }
  void outputs(auto& v) const { v[y] = select(v.on(exceeds), v[u1], v[u3]); }
};

}  // namespace flyball
