#pragma once
#include "blocks/robot/mecanum_terms.h"

namespace flyball {

struct MecanumInverse : MecanumTerms {
  static constexpr auto summary = "The wheel speeds that give a mecanum robot a wanted motion.";
  using MecanumTerms::MecanumTerms;
  Input vx = input("vx", "m/s", "wanted speed forward");
  Input vy = input("vy", "m/s", "wanted speed to the left");
  Input turn = input("omega", "rad/s", "wanted rate of turn, counter-clockwise positive");
  Output front_right = output("front_right", "rad/s", "angular speed of this wheel, forward positive");
  Output front_left = output("front_left", "rad/s", "angular speed of this wheel, forward positive");
  Output rear_left = output("rear_left", "rad/s", "angular speed of this wheel, forward positive");
  Output rear_right = output("rear_right", "rad/s", "angular speed of this wheel, forward positive");

  void outputs(auto& v) const {
    const auto left = sideways(v) * v[vy], around = lever(v) * v[turn];
    v[front_right] = (v[vx] + left + around) / v[radius];
    v[front_left] = (v[vx] - left - around) / v[radius];
    v[rear_left] = (v[vx] + left - around) / v[radius];
    v[rear_right] = (v[vx] - left + around) / v[radius];
  }
};

}  // namespace flyball
