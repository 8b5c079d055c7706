#pragma once
#include "blocks/block.h"
#include "blocks/se2.h"

namespace flyball {

struct ArcNavigation : Block {
  static constexpr auto summary = "How far a robot is off a circle, and what to steer by to follow it.";
  SampleTime ts = sample_time(*Rational::fraction(1, 100));
  bool old_law = option("law", "improved", {"improved", "old"},
                        "steer by heading and distance from the circle, or by the heading alone") == 1;
  Param centre_x = param("centre_x", 0.0, "m", any, "x of the centre");
  Param centre_y = param("centre_y", -1.0, "m", any, "y of the centre");
  Param radius =
      param("radius", 1.0, "m", any, "radius; positive when the centre is on the right of the path");
  Param approach =
      param("approach_distance", 0.2, "m", positive,
            "R0 of the improved law: at this distance and beyond, the robot is to head for the circle at a "
            "right angle");
  Pose<Input> pose = input_pose("pose", "position and heading");
  Output gamma = output("gamma", "rad", "deviation to steer by: the robot points to the right of its course");
  Output off = output("H", "m", "distance from the circle, positive on the right of the path");
  Output heading_error = output("heading_error", "rad", "direction of the tangent, less the heading");
  Output curvature = output("curvature", "1/m", "1/radius: positive when the path turns right");
  Held last = held("last_heading_error", 0.0, "rad", "heading error at the last hit");
  Relation off_centre = relation("off_centre", "the robot is not at the centre, which has no bearing there");

  void relations(auto& v) const { v[off_centre] = from_centre(v) - smallest; }
  // Ma et al. 2018 have X to the right and Y forward: their atan2(X, Y) is -atan2(centre.y, centre.x).
  void outputs(auto& v) const {
    const auto side = v[radius] / abs(v[radius]);
    const auto H = v[radius] - side * from_centre(v);
    const auto centre = seen_from(pose_in(v, pose), point_in(v, centre_x, centre_y));
    const auto error =
        select(v.on(off_centre), wrap(side * (M_PI / 2.0) + atan2(centre.y, centre.x)), v[last]);
    v[gamma] = old_law ? error : error + saturated_asin(H / v[approach]);
    v[off] = H;
    v[heading_error] = error;
    v[curvature] = 1.0 / v[radius];
  }
  void on_sample(auto& v) const { v.next(last) = v[heading_error]; }

 private:
  auto from_centre(auto& v) const {
    return distance_between(point_in(v, pose.x, pose.y), point_in(v, centre_x, centre_y));
  }
};

}  // namespace flyball
