#pragma once
#include "blocks/block.h"

namespace flyball {

struct RateLimiter : Block {
  static constexpr auto summary = "Follows its input no faster than two rates, with a short time constant.";
  static constexpr std::array aliases{"Modelica.Blocks.Nonlinear.SlewRateLimiter", "RATELIMITER"};
  Param rising = param("rising", 1.0, "any", any, "greatest rate of change, at least 0");
  Param falling = param("falling", -1.0, "any", any, "least rate of change, at most 0");
  Param tau = param("tau", 1e-3, "s", positive, "time constant with which the input is followed");
  Param initial = param("initial", 0.0, "any", any, "output at the start");
  Input u = input("u", "any", "signal");
  State x = state("x", initial, "any", "the limited signal");
  Output y = output("y", x, "the limited signal");
  Relation too_fast = relation("too_fast", "the signal is so far above that y rises at its limit");
  Relation too_slow = relation("too_slow", "the signal is so far below that y falls at its limit");

  void relations(auto& v) const {
    v[too_fast] = wanted(v) - v[rising];
    v[too_slow] = v[falling] - wanted(v);
  }
  void rates(auto& v) const {
    v.rate(x) = select(v.on(too_fast), v[rising], select(v.on(too_slow), v[falling], wanted(v)));
  }

 private:
  auto wanted(auto& v) const { return (v[u] - v[x]) / v[tau]; }
};

}  // namespace flyball
