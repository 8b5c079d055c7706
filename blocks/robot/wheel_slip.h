#pragma once
#include "blocks/block.h"

namespace flyball {

struct WheelSlip : Block {
  static constexpr auto summary = "How fast two wheels roll over the ground that turn and slip on it.";
  // Below 0 the ground carries a wheel on: it slips when it brakes.
  static constexpr Range at_most_all{-infinity, 1.0};
  Param right_slip = param("right_slip", 0.0, "1", at_most_all, "lost part of what the right wheel turns");
  Param left_slip = param("left_slip", 0.0, "1", at_most_all, "lost part of what the left wheel turns");
  Input right_turning = input("right_turning", "rad/s", "angular speed of the right wheel");
  Input left_turning = input("left_turning", "rad/s", "angular speed of the left wheel");
  Output right = output("right", "rad/s", "speed at which it would roll that far without slip");
  Output left = output("left", "rad/s", "speed at which it would roll that far without slip");

  void outputs(auto& v) const {
    v[right] = (1.0 - v[right_slip]) * v[right_turning];
    v[left] = (1.0 - v[left_slip]) * v[left_turning];
  }
};

}  // namespace flyball
