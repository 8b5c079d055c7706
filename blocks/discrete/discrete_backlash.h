#pragma once
#include "blocks/block.h"

namespace flyball {

struct DiscreteBacklash : Block {
  static constexpr auto summary = "Play between input and output at sample hits.";
  SampleTime ts = sample_time();
  Param width = param("width", 1.0, "any", non_negative, "the play");
  Param initial = param("initial", 0.0, "any", any, "output before the first hit");
  Input u = input("u", "any", "signal");
  Output y = output("y", "any", "the signal, behind the play", initial);
  Held last = held("last", initial, "any", "output at the last hit");

  void outputs(auto& v) const { v[y] = pushed(v); }
  void on_sample(auto& v) const { v.next(last) = pushed(v); }

 private:
  auto pushed(auto& v) const { return clamp(v[last], v[u] - v[width] / 2.0, v[u] + v[width] / 2.0); }
};

}  // namespace flyball
