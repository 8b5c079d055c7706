#pragma once
#include "blocks/block.h"
#include "blocks/se2.h"

namespace flyball {

struct EncoderOdometry : Block {
  static constexpr auto summary =
      "Position and heading of a robot from the counts of its two wheels, and from a gyro where it has one.";
  enum class Heading { encoder, gyro, complementary };
  SampleTime ts = sample_time(*Rational::fraction(1, 100));
  Heading source = static_cast<Heading>(
      option("heading", "encoder", {"encoder", "gyro", "complementary"},
             "turned by the wheels; read from a gyro; or turned by both, each with its weight"));
  bool has_gyro = source != Heading::encoder;
  bool corrected = flag("corrected", false, "inputs that set the position, as a landmark does");
  Param right_step = param("right_step", 5e-5, "m", positive, "way of the right wheel for a count");
  Param left_step = param("left_step", 5e-5, "m", positive, "way of the left wheel for a count");
  Param track_width = param("track_width", 0.3, "m", positive, "distance between the wheels");
  Param weight = param_if(source == Heading::complementary, "gyro_weight", 0.98, "1", unit_interval,
                          "weight of the gyro in a turn");
  Param initial_x = param("initial_x", 0.0, "m", any, "x at the start");
  Param initial_y = param("initial_y", 0.0, "m", any, "y at the start");
  Param initial_theta = param("initial_theta", 0.0, "rad", any, "heading at the start");
  Input right = input("right", "1", "counts of the right wheel since the hit before");
  Input left = input("left", "1", "counts of the left wheel since the hit before");
  // A diagram may keep its gyro when the wheels are asked instead.
  Input gyro = has_gyro ? input("gyro", "rad", "heading, as the gyro reads it")
                        : input("gyro", "rad", "heading of a gyro, which is not used", 0.0);
  Input correct = input_if(corrected, "correct", "1", "1: the position is set; 0: it is not");
  Input corrected_x = input_if(corrected, "corrected_x", "m", "x to set");
  Input corrected_y = input_if(corrected, "corrected_y", "m", "y to set");
  Held x = held("x", initial_x, "m", "x at the last hit");
  Held y = held("y", initial_y, "m", "y at the last hit");
  Held theta = held("theta", initial_theta, "rad", "heading at the last hit, counter-clockwise from +x");
  Held last_gyro =
      held_if(source == Heading::complementary, "last_gyro", 0.0, "rad", "reading at the last hit");
  Held started = held_if(source == Heading::complementary, "started", 0.0, "1", "1 after the first hit");
  Relation sets = relation_if(corrected, "sets", "the position is set");
  Pose<Output> pose = output_pose("pose", Pose<Param>{initial_x, initial_y, initial_theta},
                                  "position of the middle of the axle and heading, as estimated");

  void relations(auto& v) const {
    if (corrected) v[sets] = v[correct] - 0.5;
  }
  void outputs(auto& v) const {
    const auto now = estimate(v);
    v[pose.x] = now.x;
    v[pose.y] = now.y;
    v[pose.theta] = now.theta;
  }
  void on_sample(auto& v) const {
    const auto now = estimate(v);
    v.next(x) = now.x;
    v.next(y) = now.y;
    v.next(theta) = now.theta;
    if (source != Heading::complementary) return;
    v.next(last_gyro) = v[gyro];
    v.next(started) = 1.0;
  }

 private:
  // The wheels alone make an arc. The printed formula of its chord, s sin(d)/d and s (1 - cos(d))/d, is 0/0
  // on a straight line; that of `moved` is not. With a gyro the way has the mean heading.
  auto estimate(auto& v) const {
    const auto r = v[right_step] * v[right], l = v[left_step] * v[left];
    const auto rule = has_gyro ? Integration::midpoint : Integration::exact;
    auto now = moved(pose_in(v, Pose<Held>{x, y, theta}),
                     {(r + l) / 2.0, v.number(0.0), turn(v, (r - l) / v[track_width])}, rule);
    if (corrected) {
      now.x = select(v.on(sets), v[corrected_x], now.x);
      now.y = select(v.on(sets), v[corrected_y], now.y);
    }
    return now;
  }
  auto turn(auto& v, const auto& of_wheels) const {
    if (source == Heading::encoder) return of_wheels + 0.0;
    if (source == Heading::gyro) return v[gyro] - v[theta];
    const auto of_gyro = v[gyro] - select(v.on(started), v[last_gyro], v[gyro]);
    return v[weight] * of_gyro + (1.0 - v[weight]) * of_wheels;
  }
};

}  // namespace flyball
