#pragma once
#include "blocks/block.h"

namespace flyball {

struct LandmarkCorrection : Block {
  static constexpr auto summary = "The position of a robot that sees a landmark whose place it knows.";
  enum class Convention { bearing, ahead, behind, printed };
  Convention convention = static_cast<Convention>(
      option("convention", "bearing", {"bearing", "ahead", "behind", "printed"},
             "where the landmark is: an input; straight ahead; straight behind; or what eq. 4 of Ma et al. "
             "2018 says, which takes x from the one and y from the other"));
  bool has_bearing = convention == Convention::bearing;
  Param landmark_x = param("landmark_x", 1.0, "m", any, "x of the landmark");
  Param landmark_y = param("landmark_y", 0.0, "m", any, "y of the landmark");
  Input theta = input("theta", "rad", "heading, counter-clockwise from +x");
  Input distance = input("distance", "m", "distance of the landmark");
  Input bearing = has_bearing
                      ? input("bearing", "rad", "direction of the landmark, counter-clockwise from forward")
                      : input("bearing", "rad", "direction of the landmark, which is not used", 0.0);
  Output x = output("x", "m", "x of the robot");
  Output y = output("y", "m", "y of the robot");

  // Printed, with the heading t counter-clockwise from +y: x = X + l sin(t), y = Y + l cos(t). Here the
  // heading is t + pi/2: sin(t) = -cos(theta), cos(t) = sin(theta).
  void outputs(auto& v) const {
    const auto direction = has_bearing ? v[theta] + v[bearing] : v[theta] + 0.0;
    const double along_x = convention == Convention::behind ? 1.0 : -1.0;
    const double along_y = convention == Convention::behind || convention == Convention::printed ? 1.0 : -1.0;
    v[x] = v[landmark_x] + along_x * v[distance] * cos(direction);
    v[y] = v[landmark_y] + along_y * v[distance] * sin(direction);
  }
};

}  // namespace flyball
