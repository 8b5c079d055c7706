#pragma once
#include "blocks/block.h"

namespace flyball {

struct BouncingBall : Block {
  static constexpr auto summary = "A ball that falls and bounces on the ground at height 0.";
  Param gravity = param("gravity", 9.81, "m/s^2", positive, "acceleration of free fall");
  Param restitution = param("restitution", 0.8, "1", unit_interval, "speed after a bounce over speed before");
  Param initial_height = param("initial_height", 1.0, "m", non_negative, "height at the start");
  Param initial_velocity = param("initial_velocity", 0.0, "m/s", any, "upward velocity at the start");
  State h = state("h", initial_height, "m", "height");
  State w = state("w", initial_velocity, "m/s", "upward velocity");
  Output height = output("height", h, "height above the ground");
  Output velocity = output("velocity", w, "upward velocity");
  Crossing ground = crossing("ground", Direction::falling, "the ball meets the ground");

  void rates(auto& v) const {
    v.rate(h) = v[w];
    v.rate(w) = -v[gravity];
  }
  void crossings(auto& v) const { v[ground] = v[h]; }
  void on_crossing(Crossing, auto& v) const {
    v.next(h) = 0.0;
    v.next(w) = -v[restitution] * v[w];
  }
};

}  // namespace flyball
