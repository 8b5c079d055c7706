#pragma once
#include "blocks/control/pid_terms.h"

namespace flyball {

struct DiscretePID : PIDTerms {
  static constexpr auto summary = "Parallel PID controller at sample hits: u = P + I + D.";
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

  void outputs(auto& v) const { v[u] = limits_output ? clamp(sum(v), v[lower], v[upper]) : sum(v); }
  void on_sample(auto& v) const {
    v.next(last_I) = tracks ? I(v) + v[Ts] / v[Tt] * (v[u] - sum(v)) : I(v);
    v.next(last_D) = D(v);
    v.next(last_error) = error(v);
    v.next(last_weighted) = error(v, c);
  }

  auto sum(auto& v) const { return v[Kp] * error(v, b) + I(v) + D(v); }
  auto I(auto& v) const {
    const auto mean = rule == 0 ? v[last_error] : rule == 1 ? error(v) : (v[last_error] + error(v)) / 2.0;
    const auto integral = v[last_I] + v[Ki] * v[Ts] * mean;
    return clamps ? clamp(integral, v[lower], v[upper]) : integral;
  }
  // Backward differences of D = Kd s w, and of D = Kd N s/(s + N) w.
  auto D(auto& v) const {
    const auto change = error(v, c) - v[last_weighted];
    return filters ? (v[last_D] + v[Kd] * v[N] * change) / (1.0 + v[N] * v[Ts]) : v[Kd] * change / v[Ts];
  }
};

}  // namespace flyball
