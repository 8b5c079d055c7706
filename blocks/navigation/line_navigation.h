#pragma once
#include "blocks/block.h"
#include "blocks/se2.h"

namespace flyball {

struct LineNavigation : Block {
  static constexpr auto summary =
      "How far a robot is off a straight line, and what to steer by to follow it.";
  SampleTime ts = sample_time(*Rational::fraction(1, 100));
  bool old_law = option("law", "improved", {"improved", "old"},
                        "steer by heading and distance from the line, or by the bearing of its end") == 1;
  Param x1 = param("x1", 0.0, "m", any, "x of a point of the line");
  Param y1 = param("y1", 0.0, "m", any, "y of a point of the line");
  Param x2 = param("x2", 1.0, "m", any, "x of the point that it leads to");
  Param y2 = param("y2", 0.0, "m", any, "y of the point that it leads to");
  Param approach =
      param("approach_distance", 0.2, "m", positive,
            "R0 of the improved law: at this distance and beyond, the robot is to head for the line at a "
            "right angle");
  Param tolerance = param("tolerance", 5e-3, "m", non_negative, "distance from the end that counts as there");
  Pose<Input> pose = input_pose("pose", "position and heading");
  Output gamma = output("gamma", "rad", "deviation to steer by: the robot points to the right of its course");
  Output off = output("H", "m", "distance from the line, positive on its right");
  Output heading_error = output("heading_error", "rad", "direction of the line, less the heading");
  Output distance = output("distance", "m", "distance from the end of the line");
  Output arrived = output("arrived", "1", "1 within the tolerance of the end, else 0");
  Held last = held_if(old_law, "last_gamma", 0.0, "rad", "gamma at the last hit");
  Relation near = relation("near", "the end of the line is within the tolerance");

  void relations(auto& v) const { v[near] = v[tolerance] - distance_between(at(v), end(v)) + smallest; }
  void outputs(auto& v) const {
    const auto H = right_of_line(at(v), {v[x1], v[y1]}, end(v));
    const auto error = wrap(atan2(v[y2] - v[y1], v[x2] - v[x1]) - v[pose.theta]);
    v[gamma] = deviation(v, H, error);
    v[off] = H;
    v[heading_error] = error;
    v[distance] = distance_between(at(v), end(v));
    v[arrived] = select(v.on(near), v.number(1.0), v.number(0.0));
  }
  void on_sample(auto& v) const {
    if (old_law) v.next(last) = v[gamma];
  }

 private:
  auto at(auto& v) const { return point_in(v, pose.x, pose.y); }
  auto end(auto& v) const { return point_in(v, x2, y2); }
  // Ma et al. 2018 count headings q clockwise from +y, so q - atan2(x2 - x1, y2 - y1) is the heading error
  // here. Their bearing of the end is clockwise, too, and positive where the robot points to the left of it.
  auto deviation(auto& v, const auto& H, const auto& error) const {
    if (!old_law) return error + saturated_asin(H / v[approach]);
    const auto to = seen_from(pose_in(v, pose), end(v));
    return select(v.on(near), v[last], atan2(to.y, to.x));
  }
};

}  // namespace flyball
