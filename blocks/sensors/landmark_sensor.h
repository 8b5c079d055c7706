#pragma once
#include "blocks/block.h"
#include "blocks/random.h"
#include "blocks/se2.h"

namespace flyball {

struct LandmarkSensor : Block {
  static constexpr auto summary = "Where a robot sees a landmark, as long as it is near.";
  SampleTime ts = sample_time(*Rational::fraction(1, 100));
  Param stream = random_stream();
  Param landmark_x = param("landmark_x", 1.0, "m", any, "x of the landmark");
  Param landmark_y = param("landmark_y", 0.0, "m", any, "y of the landmark");
  Param range = param("range", 0.5, "m", positive, "distance from which on it is seen");
  Param distance_noise =
      param("distance_noise", 0.0, "m", non_negative, "standard deviation of the distance");
  Param bearing_noise = param("bearing_noise", 0.0, "rad", non_negative, "standard deviation of the bearing");
  Pose<Input> pose = input_pose("pose", "true position and heading");
  Output seen = output("seen", "1", "1 while the landmark is in range, else 0");
  Output distance = output("distance", "m", "distance of the landmark");
  Output bearing = output("bearing", "rad", "direction of the landmark, counter-clockwise from forward");
  Held hits = held("hits", 0.0, "1", "number of hits so far");
  Relation near = relation("near", "the landmark is in range");

  void relations(auto& v) const { v[near] = v[range] - way(v); }
  void outputs(auto& v) const {
    const auto at = seen_from(pose_in(v, pose), point_in(v, landmark_x, landmark_y));
    v[seen] = select(v.on(near), v.number(1.0), v.number(0.0));
    v[distance] = way(v) + v[distance_noise] * normal(v[stream], 4.0 * v[hits]);
    v[bearing] = atan2(at.y, at.x) + v[bearing_noise] * normal(v[stream], 4.0 * v[hits] + 1.0);
  }
  void on_sample(auto& v) const { v.next(hits) = v[hits] + 1.0; }

 private:
  auto way(auto& v) const {
    return distance_between(point_in(v, pose.x, pose.y), point_in(v, landmark_x, landmark_y));
  }
};

}  // namespace flyball
