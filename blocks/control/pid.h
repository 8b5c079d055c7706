#pragma once
#include "blocks/control/pid_terms.h"

namespace flyball {

struct PID : PIDTerms {
  static constexpr auto summary = "PID controller with a filtered derivative: u = P + I + D.";
  static constexpr std::array aliases{"Modelica.Blocks.Continuous.PID", "Modelica.Blocks.Continuous.LimPID"};
  using PIDTerms::PIDTerms;
  Param N = param("N", 100.0, "rad/s", positive, "pole of the derivative filter");
  State I = state("integral", 0.0, "any", "integral part");
  State filtered = state("filtered", 0.0, "any", "low-pass filtered error");
  Held in_manual = held_if(has_manual, "in_manual", 0.0, "1", "1 while u_manual decides");
  Relation above = relation_if(limits_output, "above", "P + I + D exceeds the upper limit");
  Relation below = relation_if(limits_output, "below", "P + I + D is under the lower limit");
  Relation on_automatic = relation_if(has_manual, "on_automatic", "automatic exceeds 1/2");
  Crossing to_automatic =
      crossing_if(has_manual, "to_automatic", Direction::rising, "the controller takes over");
  Crossing to_manual = crossing_if(has_manual, "to_manual", Direction::falling, "u_manual takes over");
  // Only I is held: integration that stops while P + I + D is at a limit would slide along it.
  StateLimits clamped = limits(I, clamps ? lower : Param{}, clamps ? upper : Param{});

  // The bit comes first when u_manual takes over, the held value when the controller does: with it comes I.
  void outputs(auto& v) const {
    v[u] = has_manual ? select(both(v.on(on_automatic), opposite(v.on(in_manual))), limited(v), v[u_manual])
                      : limited(v);
  }
  void rates(auto& v) const {
    v.rate(filtered) = v[N] * (error(v, c) - v[filtered]);
    v.rate(I) = clamped.rate(v, free_rate(v));
  }
  void relations(auto& v) const {
    if (limits_output) v[above] = sum(v) - v[upper];
    if (limits_output) v[below] = v[lower] - sum(v);
    if (has_manual) v[on_automatic] = v[automatic] - 0.5;
    clamped.relations(v, free_rate(v));
  }
  void crossings(auto& v) const {
    if (has_manual) v[to_automatic] = v[automatic] - 0.5;
    if (has_manual) v[to_manual] = v[automatic] - 0.5;
    clamped.crossings(v);
  }
  void on_crossing(Crossing which, auto& v) const {
    if (which == to_automatic) v.next(I) = select(v.on(in_manual), v[I] + (v[u_manual] - sum(v)), v[I]);
    if (which == to_automatic) v.next(in_manual) = 0.0;
    if (which == to_manual) v.next(in_manual) = 1.0;
    clamped.on_crossing(which, v);
  }

  auto sum(auto& v) const {
    return with_feed_forward(
        v, proportional(v) * error(v, b) + v[I] + derivative(v, N) * v[N] * (error(v, c) - v[filtered]));
  }
  auto limited(auto& v) const {
    return limits_output ? select(v.on(above), v[upper], select(v.on(below), v[lower], sum(v))) : sum(v);
  }
  auto free_rate(auto& v) const {
    const auto rate = integral(v) * error(v);
    const auto free = tracks ? rate + (target(v) - sum(v)) / v[Tt] : rate;
    return has_manual ? select(v.on(in_manual), v.number(0.0), free) : free;
  }
};

}  // namespace flyball
