#pragma once
#include "blocks/block.h"

namespace flyball {

struct Divide : Block {
  static constexpr auto summary = "Divides one signal by another, which must not pass zero.";
  static constexpr std::array aliases{"Modelica.Blocks.Math.Division"};
  bool jumps =
      flag("divisor_jumps", false, "the divisor may change its sign in a jump; else that is an error");
  Input u1 = input("u1", "any", "dividend");
  Input u2 = input("u2", "any", "divisor");
  Output y = output("y", "any", "u1 over u2");
  Held singular = jumps ? Held{} : run_end("singular", RunEnd::error, "the divisor u2 passes zero");
  Crossing pole = crossing_if(!jumps, "pole", Direction::either, "the divisor changes its sign");

  void outputs(auto& v) const { v[y] = v[u1] / v[u2]; }
  void crossings(auto& v) const {
    if (!jumps) v[pole] = v[u2];
  }
  void on_crossing(Crossing, auto& v) const { v.next(singular) = 1.0; }
};

}  // namespace flyball
