#pragma once
#include "blocks/block.h"
#include "blocks/se2.h"

namespace flyball {

struct PathSequencer : Block {
  static constexpr auto summary = "Passes on the deviations from that part of a path that a robot is on.";
  SampleTime ts = sample_time(*Rational::fraction(1, 100));
  int parts = count("parts", 2, 1, 100, "number of parts");
  Coefficients end_x = coefficients("end_x", {1.0, 2.0}, "m", "x of the end of each part", Entries::all);
  Coefficients end_y = coefficients("end_y", {0.0, 0.0}, "m", "y of the end of each part", Entries::all);
  Coefficients end_theta = coefficients(
      "end_theta", {0.0, 0.0}, "rad", "direction of the path there, counter-clockwise from +x", Entries::all);
  Coefficients curvatures = coefficients(
      "curvature", {0.0, 0.0}, "1/m", "curvature of each part, positive when it turns right", Entries::all);
  // Else half a circle would end where it begins.
  Param range = param("end_range", 0.3, "m", positive, "distance from its end within which a part can end");
  Pose<Input> pose = input_pose("pose", "position and heading");
  Inputs gammas = inputs("gamma", parts, "rad", "deviation to steer by on this part");
  Inputs distances = inputs("H", parts, "m", "distance from this part");
  Output gamma = output("gamma", "rad", "deviation to steer by");
  Output off = output("H", "m", "distance from the path, positive on its right");
  Output curvature = output("curvature", "1/m", "curvature of the path, positive when it turns right");
  Output part = output("part", "1", "the part that the robot is on, from 1; one more after the last");
  Output done = output("done", "1", "1 after the last part, else 0");
  Helds ended = helds("ended", std::vector<Param>(parts), "1", "1 when this part had ended by the last hit");
  Relations passes = relations_each("passes", parts, "the robot is past the end of this part, and near it");

  explicit PathSequencer(Settings* settings) : Block(settings) {
    check("end_x", end_x);
    check("end_y", end_y);
    check("end_theta", end_theta);
    check("curvature", curvatures);
  }

  void relations(auto& v) const {
    for (int k = 0; k < parts; ++k) {
      const auto at = pose_in(v, pose);
      const auto dx = at.x - v[of(end_x, k)], dy = at.y - v[of(end_y, k)];
      const auto along = dx * cos(v[of(end_theta, k)]) + dy * sin(v[of(end_theta, k)]);
      v[passes[k]] = min(along + smallest, v[range] - hypot(dx, dy));
    }
  }
  void outputs(auto& v) const {
    const auto one = v.number(1.0);
    auto deviation = v[gammas[0]], distance = v[distances[0]], bend = v[of(curvatures, 0)], number = one;
    auto is_done = v.number(0.0);
    for_each_part(v, [&](int k, const auto& has_ended) {
      is_done = select(has_ended, one, v.number(0.0));
      number += is_done;
      if (k + 1 == parts) return;
      deviation = select(has_ended, v[gammas[k + 1]], deviation);
      distance = select(has_ended, v[distances[k + 1]], distance);
      bend = select(has_ended, v[of(curvatures, k + 1)], bend);
    });
    v[gamma] = deviation;
    v[off] = distance;
    v[curvature] = bend;
    v[part] = number;
    v[done] = is_done;
  }
  void on_sample(auto& v) const {
    for_each_part(v, [&](int k, const auto& has_ended) {
      v.next(ended[k]) = select(has_ended, v.number(1.0), v.number(0.0));
    });
  }

 private:
  static Param of(const Coefficients& list, int k) { return list.entries()[k].param; }
  void check(const std::string& key, const Coefficients& list) {
    if (list.columns() == parts) return;
    refuse(key, "expected " + std::to_string(parts) + " numbers, one for each part, found " +
                    std::to_string(list.columns()));
  }
  /// Calls with the number of each part and whether it has ended, which it only does after the one before.
  void for_each_part(auto& v, auto&& call) const {
    auto has_ended = either(v.on(ended[0]), v.on(passes[0]));
    call(0, has_ended);
    for (int k = 1; k < parts; ++k) {
      has_ended = either(v.on(ended[k]), both(has_ended, v.on(passes[k])));
      call(k, has_ended);
    }
  }
};

}  // namespace flyball
