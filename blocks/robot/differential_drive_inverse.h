#pragma once
#include "blocks/robot/differential_drive_terms.h"

namespace flyball {

struct DifferentialDriveInverse : DifferentialDriveTerms {
  static constexpr auto summary =
      "The wheel speeds that give a robot with two driven wheels a wanted motion.";
  using DifferentialDriveTerms::DifferentialDriveTerms;
  SampleTime ts = sample_time_if_given();
  Input speed = input("v", "m/s", "wanted forward speed");
  Input turn = input("omega", "rad/s", "wanted rate of turn, counter-clockwise positive");
  Output right = output("right", "rad/s", "angular speed of the right wheel, forward positive");
  Output left = output("left", "rad/s", "angular speed of the left wheel, forward positive");

  void outputs(auto& v) const {
    v[right] = (2.0 * v[speed] + v[track_width] * v[turn]) / v[wheel_diameter];
    v[left] = (2.0 * v[speed] - v[track_width] * v[turn]) / v[wheel_diameter];
  }
};

}  // namespace flyball
