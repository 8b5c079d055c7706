#pragma once
#include "blocks/block.h"

namespace flyball {

struct Ramp : Block {
  static constexpr auto summary = "Rises with a constant slope from a given time on.";
  static constexpr std::array aliases{"RAMP"};
  Param slope = param("slope", 1.0, "any", any, "change per second");
  Param start = param("start", 0.0, "s", any, "time at which it begins to rise");
  Param initial = param("initial", 0.0, "any", any, "value until then");
  Output y = output("y", "any", "the value");
  Held started = held("started", 0.0, "1", "1 from the start on");
  Alarm begin = alarm("begin", "the start of the ramp");

  void schedule(auto& v) const { v[begin] = select(v.on(started), never, v[start]); }
  void on_time(auto& v) const { v.next(started) = 1.0; }
  void outputs(auto& v) const {
    v[y] = select(v.on(started), v[initial] + v[slope] * (v.time() - v[start]), v[initial]);
  }
};

}  // namespace flyball
