#pragma once
#include "blocks/block.h"

namespace flyball {

/// Kanayama, Kimura, Miyazaki, Noguchi: A stable tracking control method for an autonomous mobile robot,
/// 1990.
struct KanayamaTracker : Block {
  static constexpr auto summary = "Tracks a pose with a robot that moves along its heading only.";
  SampleTime ts = sample_time_if_given();
  Param k1 = param("k1", 1.0, "1/s", any, "speed over the error ahead");
  Param k2 = param("k2", 1.0, "1/m^2", any, "turn over the error to the left, by way driven");
  Param k3 = param("k3", 1.0, "1/m", any, "turn over the sine of the error of heading, by way driven");
  Pose<Input> error = input_pose("error", "x ahead, y to the left, as PoseError gives it");
  Input v_reference = input("v_reference", "m/s", "speed of what is tracked");
  Input omega_reference = input("omega_reference", "rad/s", "turn of what is tracked", 0.0);
  Output speed = output("v", "m/s", "forward speed");
  Output turn = output("omega", "rad/s", "rate of turn, counter-clockwise positive");

  void outputs(auto& v) const {
    v[speed] = v[v_reference] * cos(v[error.theta]) + v[k1] * v[error.x];
    v[turn] = v[omega_reference] + v[v_reference] * (v[k2] * v[error.y] + v[k3] * sin(v[error.theta]));
  }
};

}  // namespace flyball
