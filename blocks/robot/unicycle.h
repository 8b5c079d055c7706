#pragma once
#include "blocks/block.h"

namespace flyball {

struct Unicycle : Block {
  static constexpr auto summary = "Kinematics of a robot that moves along its heading.";
  Param initial_x = param("initial_x", 0.0, "m", any, "x at the start");
  Param initial_y = param("initial_y", 0.0, "m", any, "y at the start");
  Param initial_theta = param("initial_theta", 0.0, "rad", any, "heading at the start");
  Input speed = input("v", "m/s", "forward speed");
  Input turn = input("omega", "rad/s", "rate of turn, counter-clockwise positive");
  State x = state("x", initial_x, "m", "position along x");
  State y = state("y", initial_y, "m", "position along y");
  State theta = state("theta", initial_theta, "rad", "heading, counter-clockwise from +x");
  Pose<Output> pose = output_pose("pose", Pose<State>{x, y, theta}, "position and heading");

  void rates(auto& v) const {
    v.rate(x) = v[speed] * cos(v[theta]);
    v.rate(y) = v[speed] * sin(v[theta]);
    v.rate(theta) = v[turn];
  }
};

}  // namespace flyball
