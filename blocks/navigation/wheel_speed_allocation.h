#pragma once
#include "blocks/block.h"

namespace flyball {

struct WheelSpeedAllocation : Block {
  static constexpr auto summary = "Speeds of two wheels for a path of this curvature and a correction of it.";
  Param track_width = param("track_width", 0.3, "m", positive, "distance between the wheels");
  Param limit = param("limit", 1.0, "1", non_negative,
                      "greatest size of the correction; up to 1, no wheel turns back on a straight path");
  Input speed = input("v", "m/s", "mean speed of the wheels");
  Input curvature = input("curvature", "1/m", "curvature of the path, positive when it turns right", 0.0);
  Input U = input("U", "1", "correction, positive to the right");
  Output right = output("right", "m/s", "speed of the right wheel");
  Output left = output("left", "m/s", "speed of the left wheel");
  Output limited = output("correction", "1", "correction within its limit");
  Relation above = relation("above", "the correction exceeds its limit");
  Relation below = relation("below", "the correction is under its negative limit");

  void relations(auto& v) const {
    v[above] = v[U] - v[limit];
    v[below] = -v[limit] - v[U];
  }
  void outputs(auto& v) const {
    const auto u = select(v.on(above), +v[limit], select(v.on(below), -v[limit], v[U]));
    const auto share = v[track_width] * v[curvature] / 2.0 + u;
    v[right] = (1.0 - share) * v[speed];
    v[left] = (1.0 + share) * v[speed];
    v[limited] = u;
  }
};

}  // namespace flyball
