#pragma once
#include "blocks/block.h"

namespace flyball {

struct Integrator : Block {
  static constexpr auto summary =
      "Integrates its input over time, between limits and with a reset where asked for.";
  static constexpr std::array aliases{"Modelica.Blocks.Continuous.Integrator", "INTEGRAL_f", "INTEGRAL_m"};
  int reset = option("reset", "none", {"none", "rising", "falling", "either"},
                     "which change of the input `reset` sets the integral to `initial`");
  Param initial = param("initial", 0.0, "any", any, "value at the start");
  Param lower = param_if(given("lower"), "lower", 0.0, "any", any, "lower limit, if given");
  Param upper = param_if(given("upper"), "upper", 0.0, "any", any, "upper limit, if given");
  // Halfway between the two values of a switching signal, which never gets below 0.
  Param threshold =
      param_if(reset > 0, "threshold", 0.5, "any", any, "level of `reset` that counts as its change");
  Input u = input("u", "any", "rate of change");
  Input trigger = input_if(reset > 0, "reset", "any", "sets the integral to `initial`");
  State x = state("x", initial, "any", "the integral");
  Output y = output("y", x, "the integral");
  Crossing change = crossing_if(reset > 0, "change", direction(), "`reset` passes its threshold");
  StateLimits limited = limits(x, lower, upper);

  void rates(auto& v) const { v.rate(x) = limited.rate(v, v[u]); }
  void relations(auto& v) const { limited.relations(v, v[u]); }
  void crossings(auto& v) const {
    if (change.declared()) v[change] = v[trigger] - v[threshold];
    limited.crossings(v);
  }
  void on_crossing(Crossing c, auto& v) const {
    if (c == change) v.next(x) = v[initial];
    limited.on_crossing(c, v);
  }

 private:
  Direction direction() const {
    return reset == 1 ? Direction::rising : reset == 2 ? Direction::falling : Direction::either;
  }
};

}  // namespace flyball
