#pragma once
#include "blocks/block.h"

namespace flyball {

struct VelocityLimiter : Block {
  static constexpr auto summary = "Keeps speed and turn between least and largest values that a user sets.";
  SampleTime ts = sample_time();
  Param v_min = param("v_min", 0.0, "m/s", any, "least speed, not above v_max");
  Param v_max = param("v_max", 1.0, "m/s", any, "largest speed");
  Param omega_min =
      param("omega_min", 0.0, "rad/s", non_negative, "least turn to either side, not above omega_max");
  Param omega_max = param("omega_max", 1.0, "rad/s", non_negative, "largest turn to either side");
  Input speed = input("v", "m/s", "wanted speed");
  Input turn = input("omega", "rad/s", "wanted turn");
  Output v_limited = output("v_limited", "m/s", "the speed between its limits");
  Output omega_limited = output("omega_limited", "rad/s", "the turn between its limits; 0 stays 0");
  Output limits_v = output("limits_v", "1", "1 while a limit changes the speed");
  Output limits_omega = output("limits_omega", "1", "1 while a limit changes the turn");

  void outputs(auto& v) const {
    const auto side = stepwise([](double x) { return (x > 0.0) - (x < 0.0) + 0.0; }, v[turn]);
    const auto to = clamp(v[speed], v[v_min], v[v_max]);
    const auto turned = side * clamp(abs(v[turn]), v[omega_min], v[omega_max]);
    const auto differs = [](double a, double b) { return a == b ? 0.0 : 1.0; };
    v[v_limited] = to;
    v[omega_limited] = turned;
    v[limits_v] = stepwise(differs, to, v[speed]);
    v[limits_omega] = stepwise(differs, turned, v[turn]);
  }
};

}  // namespace flyball
