#pragma once
#include "blocks/block.h"

namespace flyball {

struct Derivative : Block {
  static constexpr auto summary = "The filtered time derivative of its input: N s/(s + N).";
  static constexpr std::array aliases{"Modelica.Blocks.Continuous.Derivative", "DERIV"};
  Param N = param("N", 100.0, "rad/s", positive, "pole of the filter: the derivative is late by 1/N");
  Param initial = param("initial", 0.0, "any", any, "value of the input before the start");
  Input u = input("u", "any", "signal");
  State filtered = state("filtered", initial, "any", "low-pass filtered signal");
  Output y = output("y", "any", "rate of change of the filtered signal");

  void rates(auto& v) const { v.rate(filtered) = v[N] * (v[u] - v[filtered]); }
  void outputs(auto& v) const { v[y] = v[N] * (v[u] - v[filtered]); }
};

}  // namespace flyball
