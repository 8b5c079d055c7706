#pragma once
#include "blocks/block.h"

namespace flyball {

struct ZeroOrderHold : Block {
  static constexpr auto summary = "Samples its input and holds it until the next hit.";
  static constexpr std::array aliases{"Modelica.Blocks.Discrete.ZeroOrderHold", "SAMPHOLD", "SAMPHOLD_m"};
  SampleTime ts = sample_time();
  Input u = input("u", "any", "signal");
  Output y = output("y", "any", "the signal at the last hit");

  void outputs(auto& v) const { v[y] = v[u]; }
};

}  // namespace flyball
