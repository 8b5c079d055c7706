#pragma once
#include "blocks/robot/differential_drive_terms.h"

namespace flyball {

struct DifferentialDriveForward : DifferentialDriveTerms {
  static constexpr auto summary = "The motion that two driven wheels give a robot.";
  using DifferentialDriveTerms::DifferentialDriveTerms;
  Input right = input("right", "rad/s", "angular speed of the right wheel, forward positive");
  Input left = input("left", "rad/s", "angular speed of the left wheel, forward positive");
  Output speed = output("v", "m/s", "forward speed");
  Output turn = output("omega", "rad/s", "rate of turn, counter-clockwise positive");

  void outputs(auto& v) const {
    v[speed] = speed_of(v, v[right], v[left]);
    v[turn] = turn_of(v, v[right], v[left]);
  }
};

}  // namespace flyball
