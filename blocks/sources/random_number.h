#pragma once
#include "blocks/block.h"
#include "blocks/random.h"

namespace flyball {

struct RandomNumber : Block {
  static constexpr auto summary = "Normally distributed random numbers, a new one at each sample hit.";
  static constexpr std::array aliases{"Modelica.Blocks.Noise.NormalNoise"};
  SampleTime ts = sample_time();
  Param stream = random_stream();
  Param mean = param("mean", 0.0, "any", any, "mean value");
  Param deviation = param("deviation", 1.0, "any", non_negative, "standard deviation");
  Output y = output("y", "any", "the number");
  Held hits = held("hits", 0.0, "1", "number of hits so far");

  void outputs(auto& v) const { v[y] = v[mean] + v[deviation] * normal(v[stream], v[hits]); }
  void on_sample(auto& v) const { v.next(hits) = v[hits] + 1.0; }
};

}  // namespace flyball
