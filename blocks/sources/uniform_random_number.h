#pragma once
#include "blocks/block.h"
#include "blocks/random.h"

namespace flyball {

struct UniformRandomNumber : Block {
  static constexpr auto summary = "Uniformly distributed random numbers, a new one at each sample hit.";
  static constexpr std::array aliases{"Modelica.Blocks.Noise.UniformNoise", "RAND_m", "RAND_f"};
  SampleTime ts = sample_time();
  Param stream = random_stream();
  Param lower = param("lower", -1.0, "any", any, "lower end");
  Param upper = param("upper", 1.0, "any", any, "upper end");
  Output y = output("y", "any", "the number");
  Held hits = held("hits", 0.0, "1", "number of hits so far");

  void outputs(auto& v) const { v[y] = v[lower] + (v[upper] - v[lower]) * uniform(v[stream], v[hits]); }
  void on_sample(auto& v) const { v.next(hits) = v[hits] + 1.0; }
};

}  // namespace flyball
