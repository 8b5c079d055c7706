#pragma once
#include "blocks/block.h"

namespace flyball {

struct Chirp : Block {
  static constexpr auto summary = "A sine whose frequency changes linearly with time.";
  Param amplitude = param("amplitude", 1.0, "any", any, "amplitude");
  Param initial_frequency = param("initial_frequency", 1.0, "rad/s", any, "angular frequency at time 0");
  Param target_time = param("target_time", 10.0, "s", positive, "time of the target frequency");
  Param target_frequency = param("target_frequency", 10.0, "rad/s", any,
                                 "angular frequency at the target time; it goes on from there");
  Output y = output("y", "any", "the value");

  // The phase is the integral of the frequency.
  void outputs(auto& v) const {
    const auto t = v.time();
    const auto drift = (v[target_frequency] - v[initial_frequency]) / v[target_time];
    v[y] = v[amplitude] * sin((v[initial_frequency] + drift * t / 2.0) * t);
  }
};

}  // namespace flyball
