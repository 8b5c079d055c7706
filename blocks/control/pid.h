#pragma once
#include "blocks/control/pid_terms.h"

namespace flyball {

struct PID : PIDTerms {
  static constexpr auto summary = "Parallel PID controller with a filtered derivative: u = P + I + D.";
  using PIDTerms::PIDTerms;
  Param N = param("N", 100.0, "rad/s", positive, "pole of the derivative filter");
  State I = state("integral", 0.0, "any", "integral part");
  State filtered = state("filtered", 0.0, "any", "low-pass filtered error");
  Relation above = relation_if(limits_output, "above", "P + I + D exceeds the upper limit");
  Relation below = relation_if(limits_output, "below", "P + I + D is under the lower limit");
  // Only I is held: integration that stops while P + I + D is at a limit would slide along it.
  StateLimits clamped = limits(I, clamps ? lower : Param{}, clamps ? upper : Param{});

  void outputs(auto& v) const {
    v[u] = limits_output ? select(v.on(above), v[upper], select(v.on(below), v[lower], sum(v))) : sum(v);
  }
  void rates(auto& v) const {
    v.rate(filtered) = v[N] * (error(v, c) - v[filtered]);
    v.rate(I) = clamped.rate(v, free_rate(v));
  }
  void relations(auto& v) const {
    if (limits_output) v[above] = sum(v) - v[upper];
    if (limits_output) v[below] = v[lower] - sum(v);
    clamped.relations(v, free_rate(v));
  }
  void crossings(auto& v) const { clamped.crossings(v); }
  void on_crossing(Crossing which, auto& v) const { clamped.on_crossing(which, v); }
  auto sum(auto& v) const { return v[Kp] * error(v, b) + v[I] + v[Kd] * v[N] * (error(v, c) - v[filtered]); }
  auto free_rate(auto& v) const {
    return tracks ? v[Ki] * error(v) + (v[u] - sum(v)) / v[Tt] : v[Ki] * error(v);
  }
};

}  // namespace flyball
