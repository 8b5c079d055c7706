#pragma once
#include "blocks/control/pid_terms.h"

namespace flyball {

struct DiscretePID : PIDTerms {
  static constexpr auto summary = "PID controller at sample hits: u = P + I + D.";
  using PIDTerms::PIDTerms;
  SampleTime Ts = sample_time();
  int rule = option("integral", "backward", {"forward", "backward", "trapezoidal"}, "rule of integration");
  bool filters =
      option("derivative", "difference", {"difference", "filtered"}, "backward difference, or with a pole N");
  Param N = param_if(filters, "N", 100.0, "rad/s", positive, "pole of the derivative filter");
  Held last_I = held("integral", 0.0, "any", "integral part at the last hit");
  Held last_D = held("derivative", 0.0, "any", "derivative part at the last hit");
  Held last_error = held("error", 0.0, "any", "error at the last hit");
  Held last_weighted = held("weighted_error", 0.0, "any", "error with the setpoint weight c at the last hit");

  void outputs(auto& v) const { v[u] = has_manual ? blend(v, limited(v), v[u_manual]) : limited(v); }
  void on_sample(auto& v) const {
    const auto free = tracks ? I(v) + v[Ts] / v[Tt] * (target(v) - sum(v)) : I(v);
    // In manual mode I is what makes the sum u_manual.
    v.next(last_I) = has_manual ? blend(v, free, I(v) + (v[u_manual] - sum(v))) : free;
    v.next(last_D) = D(v);
    v.next(last_error) = error(v);
    v.next(last_weighted) = error(v, c);
  }

  /// The one or the other, by value: a sampled block has nothing to locate.
  auto blend(auto& v, const auto& in_automatic, const auto& in_manual) const {
    const auto share = clamp(floor(v[automatic] + 0.5), v.number(0.0), v.number(1.0));
    return share * in_automatic + (1.0 - share) * in_manual;
  }
  auto sum(auto& v) const { return with_feed_forward(v, proportional(v) * error(v, b) + I(v) + D(v)); }
  auto limited(auto& v) const { return limits_output ? clamp(sum(v), v[lower], v[upper]) : sum(v); }
  auto I(auto& v) const {
    const auto mean = rule == 0 ? v[last_error] : rule == 1 ? error(v) : (v[last_error] + error(v)) / 2.0;
    const auto next = v[last_I] + integral(v) * v[Ts] * mean;
    return clamps ? clamp(next, v[lower], v[upper]) : next;
  }
  // Backward differences of D = Kd s w, and of D = Kd N s/(s + N) w.
  auto D(auto& v) const {
    const auto change = derivative(v, N) * (error(v, c) - v[last_weighted]);
    return filters ? (v[last_D] + v[N] * change) / (1.0 + v[N] * v[Ts]) : change / v[Ts];
  }
};

}  // namespace flyball
