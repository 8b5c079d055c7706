#pragma once
#include "blocks/block.h"
#include "blocks/random.h"

namespace flyball {

struct Gyro : Block {
  static constexpr auto summary =
      "A gyro of one axis that reports the heading, with the errors of its scale, its mounting and its rate.";
  SampleTime ts = sample_time(*Rational::fraction(1, 100));
  Param stream = random_stream();
  Param reference = param("reference", 0.0, "rad", any, "heading at which it was set, and is right");
  Param scale_error = param("scale_error", 0.0, "1", any, "part of a turn that it reads too much");
  Param misalignment =
      param("misalignment", 0.0, "rad", any, "error after half a turn, of an axis that is not upright");
  Param bias = param("bias", 0.0, "rad/s", any, "error of the rate at the start");
  Param noise = param("noise", 0.0, "rad", non_negative, "standard deviation of a reading");
  // The coefficients N and K of an Allan deviation sqrt(N^2/tau + K^2 tau/3).
  Param angle_walk = param("angle_random_walk", 0.0, "any", non_negative,
                           "deviation of the angle over the root of time, by white noise of the rate: "
                           "\"0.1 deg/sqrt(1 h)\"");
  Param rate_walk = param("rate_random_walk", 0.0, "any", non_negative,
                          "deviation of the bias over the root of time: \"1 deg/h/sqrt(1 h)\"");
  Input theta = input("theta", "rad", "true heading, counter-clockwise from +x");
  Output heading = output("heading", "rad", "heading, as it reads it", reference);
  Held angle_error = held("angle_error", 0.0, "rad", "what the noise of the rate has added up to");
  Held bias_error = held("bias_error", 0.0, "rad/s", "how far the bias has walked");
  Held hits = held("hits", 0.0, "1", "number of hits so far");

  void outputs(auto& v) const {
    const auto turned = v[theta] - v[reference];
    const auto half = sin(turned / 2.0);
    v[heading] = v[theta] + v[scale_error] * turned + v[misalignment] * half * half + v[bias] * v.time() +
                 v[angle_error] + v[noise] * number(v, 0.0);
  }
  // Both walks as they are at the hits: the area under one of the bias has, beside that of its chord, the
  // variance ts^3/12 of a bridge.
  void on_sample(auto& v) const {
    const auto root = sqrt(v[ts]), walk = v[rate_walk] * root, step = number(v, 2.0);
    const auto area = v[bias_error] * v[ts] + walk * v[ts] * (step / 2.0 + number(v, 3.0) / std::sqrt(12.0));
    v.next(angle_error) = v[angle_error] + area + v[angle_walk] * root * number(v, 1.0);
    v.next(bias_error) = v[bias_error] + walk * step;
    v.next(hits) = v[hits] + 1.0;
  }

 private:
  /// Four numbers for each hit.
  auto number(auto& v, double which) const { return normal(v[stream], 4.0 * v[hits] + which); }
};

}  // namespace flyball
