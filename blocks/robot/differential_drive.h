#pragma once
#include "blocks/robot/differential_drive_terms.h"

namespace flyball {

struct DifferentialDrive : DifferentialDriveTerms {
  static constexpr auto summary = "Kinematics of a robot with two driven wheels, rolling without slip.";
  using DifferentialDriveTerms::DifferentialDriveTerms;
  Param initial_x = param("initial_x", 0.0, "m", any, "x at the start");
  Param initial_y = param("initial_y", 0.0, "m", any, "y at the start");
  Param initial_theta = param("initial_theta", 0.0, "rad", any, "heading at the start");
  Input right = input("right", "rad/s", "angular speed of the right wheel, forward positive");
  Input left = input("left", "rad/s", "angular speed of the left wheel, forward positive");
  Output speed = output("v", "m/s", "forward speed");
  Output turn = output("omega", "rad/s", "rate of turn, counter-clockwise positive");
  State x = state("x", initial_x, "m", "position along x");
  State y = state("y", initial_y, "m", "position along y");
  State theta = state("theta", initial_theta, "rad", "heading, counter-clockwise from +x");
  Pose<Output> pose =
      output_pose("pose", Pose<State>{x, y, theta}, "position of the middle of the axle and heading");

  void outputs(auto& v) const {
    v[speed] = speed_of(v, v[right], v[left]);
    v[turn] = turn_of(v, v[right], v[left]);
  }
  void rates(auto& v) const {
    v.rate(x) = v[speed] * cos(v[theta]);
    v.rate(y) = v[speed] * sin(v[theta]);
    v.rate(theta) = v[turn];
  }
};

}  // namespace flyball
