#pragma once
#include "blocks/block.h"
#include "blocks/se2.h"

namespace flyball {

// R. C. Coulter: Implementation of the pure pursuit path tracking algorithm. CMU-RI-TR-92-01, 1992.
struct PurePursuit : Block {
  static constexpr auto summary = "Steers along an arc to the point of a path that is a way ahead.";
  SampleTime ts = sample_time(*Rational::fraction(1, 100));
  Param lookahead = param("lookahead", 0.3, "m", positive, "way along the path to the point aimed at");
  Input off = input("H", "m", "distance from the path, positive on its right");
  Input heading_error = input("heading_error", "rad", "direction of the path, less the heading");
  Input bend = input("path_curvature", "1/m", "curvature of the path, positive when it turns right", 0.0);
  Output curvature = output("curvature", "1/m", "curvature to drive, positive to the right");

  // In the frame of the path where the robot is beside it: x along the path, y to the left.
  void outputs(auto& v) const {
    const auto zero = v.number(0.0);
    const auto& way = v[lookahead];
    const Pose<std::decay_t<decltype(zero)>> beside{zero, zero, zero},
        robot{zero, -v[off], -v[heading_error]};
    const auto aim = moved(beside, {way, zero, -(v[bend] * way)});
    const auto seen = seen_from(robot, {aim.x, aim.y});
    v[curvature] = -2.0 * seen.y / (seen.x * seen.x + seen.y * seen.y);
  }
};

}  // namespace flyball
