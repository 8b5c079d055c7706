#pragma once
#include "blocks/block.h"
#include "blocks/se2.h"

namespace flyball {

struct PoseIntegrator : Block {
  static constexpr auto summary = "Moves a pose from hit to hit, by velocities that are held between them.";
  SampleTime ts = sample_time();
  bool sideways = flag("sideways", false, "an input vy, for robots that also move to the side");
  Integration rule = static_cast<Integration>(
      option("method", "exact", {"exact", "midpoint", "euler"},
             "direction of a step: along its arc, along the mean heading, along the heading before it"));
  Param initial_x = param("initial_x", 0.0, "m", any, "x at the first hit");
  Param initial_y = param("initial_y", 0.0, "m", any, "y at the first hit");
  Param initial_theta = param("initial_theta", 0.0, "rad", any, "heading at the first hit");
  Input vx = input("v", "m/s", "forward speed");
  Input vy = input_if(sideways, "vy", "m/s", "speed to the left");
  Input turn = input("omega", "rad/s", "rate of turn, counter-clockwise positive");
  Held x = held("x", initial_x, "m", "position along x at the next hit");
  Held y = held("y", initial_y, "m", "position along y at the next hit");
  Held theta = held("theta", initial_theta, "rad", "heading at the next hit, counter-clockwise from +x");
  Pose<Output> pose = output_pose("pose", Pose<Param>{initial_x, initial_y, initial_theta},
                                  "position and heading at the hit");

  void outputs(auto& v) const {
    v[pose.x] = v[x];
    v[pose.y] = v[y];
    v[pose.theta] = v[theta];
  }
  void on_sample(auto& v) const {
    const auto left = sideways ? v[vy] * v[ts] : v.number(0.0);
    const auto next =
        moved(pose_in(v, Pose<Held>{x, y, theta}), {v[vx] * v[ts], left, v[turn] * v[ts]}, rule);
    v.next(x) = next.x;
    v.next(y) = next.y;
    v.next(theta) = next.theta;
  }
};

}  // namespace flyball
