#pragma once
#include "blocks/block.h"

namespace flyball {

/// The geometry of two driven wheels on one axle, rolling without slip.
struct DifferentialDriveTerms : Block {
  using Block::Block;
  Param wheel_diameter = param("wheel_diameter", 0.04, "m", positive, "diameter of a wheel");
  Param track_width = param("track_width", 0.054, "m", positive, "distance between the wheels");

  auto speed_of(auto& v, const auto& right, const auto& left) const {
    return v[wheel_diameter] / 4.0 * (right + left);
  }
  auto turn_of(auto& v, const auto& right, const auto& left) const {
    return v[wheel_diameter] / (2.0 * v[track_width]) * (right - left);
  }
};

}  // namespace flyball
