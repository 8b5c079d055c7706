#pragma once
#include <cmath>

#include "blocks/block.h"

namespace flyball {

/// The geometry of four mecanum wheels. Body frame: x forward, y left, counter-clockwise; the rollers that
/// touch the ground point from each wheel towards the middle of the robot.
struct MecanumTerms : Block {
  using Block::Block;
  static constexpr double right_angle = M_PI / 2.0;

  Param radius = param("wheel_radius", 0.05, "m", positive, "radius of a wheel");
  Param half_track =
      param("half_track", 0.2, "m", non_negative, "half the distance from left to right wheels");
  Param half_base =
      param("half_wheelbase", 0.25, "m", non_negative, "half the distance from front to rear axle");
  Param roller_angle = param("roller_angle", M_PI / 4.0, "rad", {0.0, right_angle, true, true},
                             "between the axis of a roller and the axle of its wheel");

  /// How much faster wheels turn for a motion sideways than for one forward.
  auto sideways(auto& v) const { return 1.0 / tan(v[roller_angle]); }
  /// The distance at which a turn moves the wheels.
  auto lever(auto& v) const { return v[half_track] + v[half_base] * sideways(v); }
};

}  // namespace flyball
