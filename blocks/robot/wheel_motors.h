#pragma once
#include "blocks/block.h"

namespace flyball {

struct WheelMotors : Block {
  static constexpr auto summary = "Motors of two wheels, which lag behind their commands and are not equal.";
  Param tau = param("time_constant", 0.05, "s", positive, "time constant of both motors");
  Param right_mismatch =
      param("right_mismatch", 0.0, "1", any, "by what part the right wheel turns faster than it is told");
  Param left_mismatch =
      param("left_mismatch", 0.0, "1", any, "by what part the left wheel turns faster than it is told");
  Param initial_right = param("initial_right", 0.0, "rad/s", any, "speed of the right wheel at the start");
  Param initial_left = param("initial_left", 0.0, "rad/s", any, "speed of the left wheel at the start");
  Input right_command = input("right_command", "rad/s", "wanted angular speed of the right wheel");
  Input left_command = input("left_command", "rad/s", "wanted angular speed of the left wheel");
  State right_speed = state("right_speed", initial_right, "rad/s", "angular speed of the right wheel");
  State left_speed = state("left_speed", initial_left, "rad/s", "angular speed of the left wheel");
  Output right = output("right", right_speed, "angular speed of the right wheel");
  Output left = output("left", left_speed, "angular speed of the left wheel");

  void rates(auto& v) const {
    v.rate(right_speed) = ((1.0 + v[right_mismatch]) * v[right_command] - v[right_speed]) / v[tau];
    v.rate(left_speed) = ((1.0 + v[left_mismatch]) * v[left_command] - v[left_speed]) / v[tau];
  }
};

}  // namespace flyball
