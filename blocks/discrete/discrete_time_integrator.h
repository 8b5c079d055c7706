#pragma once
#include "blocks/block.h"

namespace flyball {

struct DiscreteTimeIntegrator : Block {
  static constexpr auto summary =
      "Integrates its input at sample hits, between limits and with a reset where asked for.";
  // In the order of `choices`.
  enum class Method { forward, backward, trapezoidal };
  enum class Reset { none, rising, falling, either };
  SampleTime ts = sample_time();
  Method method = static_cast<Method>(
      option("method", "forward", {"forward", "backward", "trapezoidal"}, "rule of integration"));
  Reset reset =
      static_cast<Reset>(option("reset", "none", {"none", "rising", "falling", "either"},
                                "which change of the input `reset` sets the integral to `initial`"));
  bool resets = reset != Reset::none;
  Param gain = param("gain", 1.0, "any", any, "factor of the input");
  Param initial = param("initial", 0.0, "any", any, "integral that the first hit starts from");
  Param lower = param_if(given("lower"), "lower", 0.0, "any", any, "lower limit, if given");
  Param upper = param_if(given("upper"), "upper", 0.0, "any", any, "upper limit, if given");
  Param threshold =
      param_if(resets, "threshold", 0.5, "any", any, "level of `reset` that counts as its change");
  Input u = input("u", "any", "rate of change");
  Input trigger = input_if(resets, "reset", "any", "sets the integral to `initial`");
  Output y = output("y", "any", "the integral", initial);
  Held x = held("x", initial, "any", "integral that the next hit starts from");
  Held was_high =
      resets ? held("was_high", 0.0, "1", "1 when `reset` was above its threshold at the last hit") : Held{};
  Relation high = relation_if(resets, "high", "`reset` is above its threshold");

  void relations(auto& v) const {
    if (resets) v[high] = v[trigger] - v[threshold];
  }
  void outputs(auto& v) const { v[y] = integral(v); }
  void on_sample(auto& v) const {
    const auto now = integral(v);
    v.next(x) = method == Method::backward ? now : limited(v, now + (1.0 - share()) * area(v));
    if (resets) v.next(was_high) = select(v.on(high), v.number(1.0), v.number(0.0));
  }

 private:
  /// The part of a hit's area that its own output has already.
  double share() const {
    return method == Method::backward ? 1.0 : method == Method::trapezoidal ? 0.5 : 0.0;
  }
  auto area(auto& v) const { return v[gain] * v[ts] * v[u]; }
  auto integral(auto& v) const {
    const auto start = resets ? select(changed(v), v[initial], v[x]) : v[x];
    return limited(v, method == Method::forward ? start : start + share() * area(v));
  }
  auto limited(auto& v, auto value) const {
    if (lower.declared()) value = max(value, v[lower]);
    if (upper.declared()) value = min(value, v[upper]);
    return value;
  }
  auto changed(auto& v) const {
    const auto rises = both(v.on(high), opposite(v.on(was_high)));
    const auto falls = both(opposite(v.on(high)), v.on(was_high));
    return reset == Reset::rising ? rises : reset == Reset::falling ? falls : either(rises, falls);
  }
};

}  // namespace flyball
