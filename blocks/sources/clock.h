#pragma once
#include "blocks/block.h"

namespace flyball {

struct Clock : Block {
  static constexpr auto summary = "The time of the simulation.";
  Output y = output("y", "s", "time");

  void outputs(auto& v) const { v[y] = v.time(); }
};

}  // namespace flyball
