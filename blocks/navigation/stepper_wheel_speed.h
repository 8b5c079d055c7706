#pragma once
#include "blocks/block.h"

namespace flyball {

struct StepperWheelSpeed : Block {
  static constexpr auto summary =
      "Speed of two wheels that their motors turn by one step, or none, in a hit.";
  SampleTime ts = sample_time();
  Param step_angle = param("step_angle", 0.0065, "rad", positive, "turn of a wheel at a step");
  Input right_step = input("right_step", "1", "1 forward, -1 backward, 0 none");
  Input left_step = input("left_step", "1", "1 forward, -1 backward, 0 none");
  Output right = output("right", "rad/s", "mean speed of the right wheel until the next hit");
  Output left = output("left", "rad/s", "mean speed of the left wheel until the next hit");

  void outputs(auto& v) const {
    v[right] = v[step_angle] * v[right_step] / v[ts];
    v[left] = v[step_angle] * v[left_step] / v[ts];
  }
};

}  // namespace flyball
