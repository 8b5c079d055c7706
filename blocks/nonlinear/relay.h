#pragma once
#include "blocks/block.h"

namespace flyball {

struct Relay : Block {
  static constexpr auto summary = "Switches between two values with hysteresis.";
  static constexpr std::array aliases{"Modelica.Blocks.Logical.Hysteresis", "HYSTHERESIS"};
  Param switch_on = param("switch_on", 0.5, "any", any, "rising through this level, the signal switches on");
  Param switch_off =
      param("switch_off", -0.5, "any", any, "falling through this level, the signal switches off");
  Param on = param("on", 1.0, "any", any, "value when on");
  Param off = param("off", 0.0, "any", any, "value when off");
  Input u = input("u", "any", "signal");
  Output y = output("y", "any", "the value");
  Held closed = held("closed", 0.0, "1", "1 when on; off at the start unless the signal is above switch_on");
  Crossing turns_on = crossing("turns_on", Direction::rising, "the signal rises through switch_on");
  Crossing turns_off = crossing("turns_off", Direction::falling, "the signal falls through switch_off");

  void crossings(auto& v) const {
    v[turns_on] = v[u] - v[switch_on];
    v[turns_off] = v[u] - v[switch_off];
  }
  void on_crossing(Crossing which, auto& v) const { v.next(closed) = which == turns_on ? 1.0 : 0.0; }
  void outputs(auto& v) const { v[y] = select(v.on(closed), v[on], v[off]); }
};

}  // namespace flyball
