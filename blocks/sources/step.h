#pragma once
#include "blocks/block.h"

namespace flyball {

struct Step : Block {
  static constexpr auto summary = "Jumps from one value to another at a given time.";
  static constexpr std::array aliases{"Modelica.Blocks.Sources.Step", "STEP", "STEP_FUNCTION"};
  Param time = param("time", 1.0, "s", any, "time of the step");
  Param before = param("before", 0.0, "any", any, "value before the step");
  Param after = param("after", 1.0, "any", any, "value from the step on");
  Output y = output("y", "any", "the value");
  Held stepped = held("stepped", 0.0, "1", "1 from the step on");
  Alarm jump = alarm("jump", "the step");

  void schedule(auto& v) const { v[jump] = select(v.on(stepped), never, v[time]); }
  void on_time(auto& v) const { v.next(stepped) = 1.0; }
  void outputs(auto& v) const { v[y] = select(v.on(stepped), v[after], v[before]); }
};

}  // namespace flyball
