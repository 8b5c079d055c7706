#pragma once
#include "blocks/block.h"

namespace flyball {

struct Integrator : Block {
  static constexpr auto summary = "Integrates its input over time.";
  Param initial = param("initial", 0.0, "any", any, "value at the start");
  Input u = input("u", "any", "rate of change");
  State x = state("x", initial, "any", "the integral");
  Output y = output("y", x, "the integral");

  void rates(auto& v) const { v.rate(x) = v[u]; }
};

}  // namespace flyball
