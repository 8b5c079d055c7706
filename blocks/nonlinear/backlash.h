#pragma once
#include "blocks/block.h"

namespace flyball {

struct Backlash : Block {
  static constexpr auto summary =
      "Play between input and output: the output rests inside of it, and is pushed along at its ends.";
  static constexpr std::array aliases{"BACKLASH"};
  Param width = param("width", 1.0, "any", non_negative, "the play");
  // A contact without any give would have to know the rate of the signal to tell when it ends.
  Param tau = param("tau", 1e-3, "s", positive, "time constant of the contact: y is late by tau");
  Param initial = param("initial", 0.0, "any", any, "output at the start");
  Input u = input("u", "any", "signal");
  State x = state("x", initial, "any", "the output");
  Output y = output("y", x, "the signal, behind the play");
  Relation pushed_up = relation("pushed_up", "the signal pushes upwards");
  Relation pushed_down = relation("pushed_down", "the signal pushes downwards");

  void relations(auto& v) const {
    v[pushed_up] = over(v);
    v[pushed_down] = -under(v);
  }
  void rates(auto& v) const {
    v.rate(x) = select(v.on(pushed_up), over(v), select(v.on(pushed_down), under(v), v.number(0.0))) / v[tau];
  }

 private:
  auto over(auto& v) const { return v[u] - v[x] - v[width] / 2.0; }
  auto under(auto& v) const { return v[u] - v[x] + v[width] / 2.0; }
};

}  // namespace flyball
