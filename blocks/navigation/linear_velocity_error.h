#pragma once
#include "blocks/navigation/running_terms.h"

namespace flyball {

struct LinearVelocityError : RunningTerms {
  static constexpr auto summary = "How far a speed, or its moving average, is from its reference.";
  explicit LinearVelocityError(Settings* settings) : RunningTerms(settings, "m/s") {}
  SampleTime ts = sample_time();
  int window = count("window", 1, 1, 10000, "number of hits that the moving average is taken of");
  Input speed = input("v", "m/s", "the speed");
  Input reference = input("v_reference", "m/s", "what it is to be");
  Output error = output("error", "m/s", "size of the difference");
  Helds last =
      helds("last", std::vector<Param>(window - 1), "m/s", "speeds at the hits before, the newest first");

  void outputs(auto& v) const {
    auto total = v[speed] + v.number(0.0);
    for (int k = 0; k < last.size(); ++k) total = total + v[last[k]];
    // At first there were fewer hits.
    const auto hits_seen = window > 1 ? clamp(v[hits] + 1.0, v.number(1.0), v.number(window)) : v.number(1.0);
    const auto size = abs(total / hits_seen - v[reference]);
    v[error] = size;
    show(v, size, counted(v));
  }
  void on_sample(auto& v) const {
    keep(v, v[error], counted(v));
    for (int k = 0; k < last.size(); ++k) v.next(last[k]) = k == 0 ? v[speed] : v[last[k - 1]];
  }
};

}  // namespace flyball
