#pragma once
#include "blocks/block.h"

namespace flyball {

struct Constant : Block {
  static constexpr auto summary = "A value that does not change during a run.";
  static constexpr std::array aliases{"Modelica.Blocks.Sources.Constant", "CONST", "CONST_f", "CONST_m"};
  Param value = param("value", 1.0, "any", any, "the value");
  Output y = output("y", "any", "the value");

  void outputs(auto& v) const { v[y] = v[value]; }
};

}  // namespace flyball
