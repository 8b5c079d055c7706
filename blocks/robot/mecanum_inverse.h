#pragma once
#include "blocks/robot/mecanum_terms.h"

namespace flyball {

struct MecanumInverse : MecanumTerms {
  static constexpr auto summary = "The wheel speeds that give a mecanum robot a wanted motion.";
  using MecanumTerms::MecanumTerms;
  bool limited = given("limit");
  Param limit = param_if(limited, "limit", 15.0, "rad/s", positive,
                         "greatest speed of a wheel, if given: a faster motion is made slower as a whole");
  Input vx = input("vx", "m/s", "wanted speed forward");
  Input vy = input("vy", "m/s", "wanted speed to the left");
  Input turn = input("omega", "rad/s", "wanted rate of turn, counter-clockwise positive");
  Output front_right = output("front_right", "rad/s", "angular speed of this wheel, forward positive");
  Output front_left = output("front_left", "rad/s", "angular speed of this wheel, forward positive");
  Output rear_left = output("rear_left", "rad/s", "angular speed of this wheel, forward positive");
  Output rear_right = output("rear_right", "rad/s", "angular speed of this wheel, forward positive");
  Output scale = output("scale", "1", "the part of the wanted motion that the wheels can give");
  Relation backward = relation_if(limited, "backward", "the wanted motion is backward");
  Relation rightward = relation_if(limited, "rightward", "the wanted motion is to the right");
  Relation clockwise = relation_if(limited, "clockwise", "the wanted turn is clockwise");
  Relation beyond = relation_if(limited, "beyond", "a wheel would exceed its limit");

  void relations(auto& v) const {
    if (!limited) return;
    v[backward] = -v[vx];
    v[rightward] = -v[vy];
    v[clockwise] = -v[turn];
    v[beyond] = fastest(v, [](Relation, const auto& x) { return abs(x); }) - v[limit];
  }
  void outputs(auto& v) const {
    const auto size = [&](Relation negative, const auto& x) { return select(v.on(negative), -x, x); };
    const auto one = v.number(1.0);
    const auto share = limited ? select(v.on(beyond), v[limit] / fastest(v, size), one) : one;
    const auto forward = share * v[vx], left = share * leftward(v), around = share * turning(v);
    v[front_right] = (forward + left + around) / v[radius];
    v[front_left] = (forward - left - around) / v[radius];
    v[rear_left] = (forward + left - around) / v[radius];
    v[rear_right] = (forward - left + around) / v[radius];
    v[scale] = share;
  }

 private:
  auto leftward(auto& v) const { return sideways(v) * v[vy]; }
  auto turning(auto& v) const { return lever(v) * v[turn]; }
  /// The signs of the terms come in all combinations, so one wheel has them all alike.
  auto fastest(auto& v, auto&& size) const {
    return (size(backward, +v[vx]) + size(rightward, leftward(v)) + size(clockwise, turning(v))) / v[radius];
  }
};

}  // namespace flyball
