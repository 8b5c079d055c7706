#pragma once
#include "blocks/block.h"

namespace flyball {

// G. M. Hoffmann, C. J. Tomlin, M. Montemerlo, S. Thrun: Autonomous automobile trajectory tracking for
// off-road driving. American Control Conference 2007.
struct Stanley : Block {
  static constexpr auto summary =
      "Steers a front wheel by the heading error and by the distance of that wheel from the path.";
  SampleTime ts = sample_time(*Rational::fraction(1, 100));
  Param gain = param("gain", 2.0, "1/s", positive, "gain of the distance");
  Param wheelbase = param("wheelbase", 0.2, "m", positive,
                          "how far ahead the front wheel is, or would be if there were one");
  Param limit =
      param("limit", 0.8, "rad", {0.0, M_PI / 2.0, true, true}, "greatest angle of the front wheel");
  Input off = input("H", "m", "distance from the path, positive on its right");
  Input heading_error = input("heading_error", "rad", "direction of the path, less the heading");
  Input speed = input("v", "m/s", "forward speed");
  Input bend = input("path_curvature", "1/m", "curvature of the path, positive when it turns right", 0.0);
  Output steer = output("steer", "rad", "angle of the front wheel, positive to the right");
  Output curvature = output("curvature", "1/m", "curvature to drive, positive to the right");

  void outputs(auto& v) const {
    const auto front = v[off] + v[wheelbase] * sin(v[heading_error]);
    const auto wanted = atan(v[wheelbase] * v[bend]) - v[heading_error] - atan2(v[gain] * front, v[speed]);
    const auto angle = clamp(wanted, -v[limit], +v[limit]);
    v[steer] = angle;
    v[curvature] = tan(angle) / v[wheelbase];
  }
};

}  // namespace flyball
