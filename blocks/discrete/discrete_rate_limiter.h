#pragma once
#include "blocks/block.h"

namespace flyball {

struct DiscreteRateLimiter : Block {
  static constexpr auto summary = "Follows its input at sample hits, no faster than two rates.";
  SampleTime ts = sample_time();
  Param rising = param("rising", 1.0, "any", any, "greatest rate of change, at least 0");
  Param falling = param("falling", -1.0, "any", any, "least rate of change, at most 0");
  Param initial = param("initial", 0.0, "any", any, "output before the first hit");
  Input u = input("u", "any", "signal");
  Output y = output("y", "any", "the limited signal", initial);
  Held last = held("last", initial, "any", "output at the last hit");

  void outputs(auto& v) const { v[y] = limited(v); }
  void on_sample(auto& v) const { v.next(last) = limited(v); }

 private:
  auto limited(auto& v) const {
    return v[last] + clamp(v[u] - v[last], v[falling] * v[ts], v[rising] * v[ts]);
  }
};

}  // namespace flyball
