#pragma once
#include "blocks/block.h"
#include "blocks/random.h"

namespace flyball {

struct BandLimitedWhiteNoise : Block {
  static constexpr auto summary = "White noise of a given spectral density, up to half the sample rate.";
  static constexpr std::array aliases{"Modelica.Blocks.Noise.BandLimitedWhiteNoise"};
  SampleTime ts = sample_time();
  Param stream = random_stream();
  Param power = param("power", 0.1, "any", non_negative, "two-sided power spectral density, per Hz");
  Output y = output("y", "any", "the noise");
  Held hits = held("hits", 0.0, "1", "number of hits so far");

  // Held over a sample time, numbers of variance power / ts have the density `power` at low frequencies.
  void outputs(auto& v) const { v[y] = sqrt(v[power] / v[ts]) * normal(v[stream], v[hits]); }
  void on_sample(auto& v) const { v.next(hits) = v[hits] + 1.0; }
};

}  // namespace flyball
