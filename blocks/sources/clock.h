#pragma once
#include "blocks/block.h"

namespace flyball {

struct Clock : Block {
  static constexpr auto summary = "The time of the simulation.";
  static constexpr std::array aliases{"Modelica.Blocks.Sources.ContinuousClock", "TIME_f"};
  Output y = output("y", "s", "time");

  void outputs(auto& v) const { v[y] = v.time(); }
};

}  // namespace flyball
