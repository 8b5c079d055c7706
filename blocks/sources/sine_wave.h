#pragma once
#include "blocks/block.h"

namespace flyball {

struct SineWave : Block {
  static constexpr auto summary = "A sine of time.";
  static constexpr std::array aliases{"Modelica.Blocks.Sources.Sine", "GENSIN_f"};
  Param amplitude = param("amplitude", 1.0, "any", any, "amplitude");
  Param frequency = param("frequency", 1.0, "rad/s", any, "angular frequency");
  Param phase = param("phase", 0.0, "rad", any, "angle at time 0");
  Param bias = param("bias", 0.0, "any", any, "value about which it swings");
  Output y = output("y", "any", "the value");

  void outputs(auto& v) const { v[y] = v[amplitude] * sin(v[frequency] * v.time() + v[phase]) + v[bias]; }
};

}  // namespace flyball
