#pragma once
#include "blocks/block.h"
#include "blocks/se2.h"

namespace flyball {

struct PoseError : Block {
  static constexpr auto summary =
      "Where a waypoint is, as the robot sees it: ahead, to the left, and turned.";
  SampleTime ts = sample_time_if_given();
  Pose<Input> pose = input_pose("pose", "of the robot");
  Pose<Input> waypoint = input_pose("waypoint", "where the robot is to be");
  Pose<Output> error = output_pose("error", "x ahead, y to the left; theta within half a turn");

  void outputs(auto& v) const {
    const auto seen = seen_from(pose_in(v, pose), {v[waypoint.x], v[waypoint.y]});
    v[error.x] = seen.x;
    v[error.y] = seen.y;
    v[error.theta] = wrap(v[waypoint.theta] - v[pose.theta]);
  }
};

}  // namespace flyball
