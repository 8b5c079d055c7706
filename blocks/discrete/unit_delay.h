#pragma once
#include "blocks/block.h"

namespace flyball {

struct UnitDelay : Block {
  static constexpr auto summary = "Delays its input by one sample time.";
  static constexpr std::array aliases{"Modelica.Blocks.Discrete.UnitDelay", "DOLLAR", "DOLLAR_f", "DOLLAR_m"};
  SampleTime ts = sample_time();
  Param initial = param("initial", 0.0, "any", any, "output at the first hit");
  Input u = input("u", "any", "signal");
  Output y = output("y", "any", "the signal at the hit before", initial);
  Held last = held("last", initial, "any", "the signal at the last hit");

  void outputs(auto& v) const { v[y] = v[last]; }
  void on_sample(auto& v) const { v.next(last) = v[u]; }
};

}  // namespace flyball
