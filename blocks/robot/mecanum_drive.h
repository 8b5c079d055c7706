#pragma once
#include "blocks/robot/mecanum_terms.h"

namespace flyball {

struct MecanumDrive : MecanumTerms {
  static constexpr auto summary =
      "Kinematics of a robot on four mecanum wheels, with the slip that they cannot avoid.";
  using MecanumTerms::MecanumTerms;
  Param lateral_slip = param("lateral_slip", 0.0, "1", {-infinity, 1.0}, "lost part of the motion sideways");
  Param initial_x = param("initial_x", 0.0, "m", any, "x at the start");
  Param initial_y = param("initial_y", 0.0, "m", any, "y at the start");
  Param initial_theta = param("initial_theta", 0.0, "rad", any, "heading at the start");
  Inputs wheel = inputs({"front_right", "front_left", "rear_left", "rear_right"}, "rad/s",
                        "angular speed of this wheel, forward positive");
  Output vx = output("vx", "m/s", "speed forward, as the wheels have it");
  Output vy = output("vy", "m/s", "speed to the left, as the wheels have it");
  Output turn = output("omega", "rad/s", "rate of turn, counter-clockwise positive");
  Output slip = output("slip", "rad/s", "wheel speed that fits no motion; 0 when all four roll");
  State x = state("x", initial_x, "m", "position along x");
  State y = state("y", initial_y, "m", "position along y");
  State theta = state("theta", initial_theta, "rad", "heading, counter-clockwise from +x");
  Pose<Output> pose = output_pose("pose", Pose<State>{x, y, theta}, "position of the middle and heading");

  // The motion that fits the four speeds best, in least squares. Papers that have x to the right and y
  // forward: their vx is -vy here, their vy is vx.
  void outputs(auto& v) const {
    const auto &fr = v[wheel[0]], &fl = v[wheel[1]], &rl = v[wheel[2]], &rr = v[wheel[3]];
    v[vx] = v[radius] / 4.0 * (fr + fl + rl + rr);
    v[vy] = v[radius] / (4.0 * sideways(v)) * (fr - fl + rl - rr);
    v[turn] = v[radius] / (4.0 * lever(v)) * (fr - fl - rl + rr);
    v[slip] = (fr + fl - rl - rr) / 4.0;
  }
  void rates(auto& v) const {
    const auto left = (1.0 - v[lateral_slip]) * v[vy];
    v.rate(x) = v[vx] * cos(v[theta]) - left * sin(v[theta]);
    v.rate(y) = v[vx] * sin(v[theta]) + left * cos(v[theta]);
    v.rate(theta) = v[turn];
  }
};

}  // namespace flyball
