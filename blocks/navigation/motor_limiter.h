#pragma once
#include "blocks/block.h"

namespace flyball {

struct MotorLimiter : Block {
  static constexpr auto summary =
      "Keeps speed and turn of a robot with two wheels within what its motors can do.";
  SampleTime ts = sample_time();
  // In the order of `choices`.
  enum class Mode { curvature, omega_priority, v_priority };
  Mode mode = static_cast<Mode>(option("mode", "curvature", {"curvature", "omega_priority", "v_priority"},
                                       "what is kept: the radius of the turn, the turn, or the speed"));
  Param wheel_speed = param("wheel_speed_max", 3.25, "rad/s", positive, "largest speed of a wheel");
  Param wheel_diameter = param("wheel_diameter", 0.04, "m", positive, "diameter of a wheel");
  Param track_width = param("track_width", 0.054, "m", positive, "distance between the wheels");
  Input speed = input("v", "m/s", "wanted speed");
  Input turn = input("omega", "rad/s", "wanted turn");
  Input stop = input("stop", "1", "1 lets the robot stand still", 0.0);
  Output v_limited = output("v_limited", "m/s", "speed that the motors can do");
  Output omega_limited = output("omega_limited", "rad/s", "turn that they can do with it");
  Output scale = output("scale", "1", "the largest speed of a wheel over the wanted one, at most 1");

  // The faster wheel runs at |v| + |omega| track_width/2, as the ground sees it.
  void outputs(auto& v) const {
    const auto reach = v[wheel_diameter] * v[wheel_speed] / 2.0, arm = v[track_width] / 2.0;
    const auto fastest = abs(v[speed]) + arm * abs(v[turn]);
    const auto share = reach / max(fastest, reach);
    const auto goes = 1.0 - v[stop];
    v[scale] = share;
    if (mode == Mode::curvature) {
      v[v_limited] = goes * (share * v[speed]);
      v[omega_limited] = goes * (share * v[turn]);
    } else if (mode == Mode::omega_priority) {
      const auto turned = within(v[turn], reach / arm);
      v[v_limited] = goes * within(v[speed], max(v.number(0.0), reach - arm * abs(turned)));
      v[omega_limited] = goes * turned;
    } else {
      const auto to = within(v[speed], reach);
      v[v_limited] = goes * to;
      v[omega_limited] = goes * within(v[turn], (reach - abs(to)) / arm);
    }
  }

 private:
  template <class T>
  static T within(const T& x, const T& size) {
    return clamp(x, T(-size), size);
  }
};

}  // namespace flyball
