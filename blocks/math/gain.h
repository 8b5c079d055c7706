#pragma once
#include "blocks/block.h"

namespace flyball {

struct Gain : Block {
  static constexpr auto summary = "Multiplies its input by a factor.";
  static constexpr std::array aliases{"Modelica.Blocks.Math.Gain", "GAINBLK", "GAINBLK_f"};
  Param gain = param("gain", 1.0, "any", any, "factor");
  Input u = input("u", "any", "signal");
  Output y = output("y", "any", "gain times the signal");

  void outputs(auto& v) const { v[y] = v[gain] * v[u]; }
};

}  // namespace flyball
