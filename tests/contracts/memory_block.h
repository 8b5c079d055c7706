#pragma once

#include <numeric>
#include <vector>

#include "blocks/block.h"

namespace flyball::test {

struct Samples {
  std::vector<double> values;
};

/// A sampled block on double alone, with a memory and object ports: remembers its input, and publishes what
/// it remembers behind what it is given.
struct Recorder : Block {
  static constexpr auto summary = "Remembers the signal at its hits.";
  static constexpr bool differentiable = false;
  SampleTime ts = sample_time();
  Param gain = param("gain", 2.0, "any", any, "factor");
  Input u = input("u", "any", "signal");
  Output y = output("y", "any", "gain times the mean of the remembered values and those of `before`");
  Held hits = held("hits", 0.0, "1", "number of hits");
  Memory<Samples> remembered = memory<Samples>("remembered", "values at the hits");
  ObjectInput<Samples> before = object_input<Samples>("before", "values to put in front");
  ObjectOutput<Samples> all = object_output<Samples>("all", "all values");

  void outputs(auto& v) const {
    v[remembered].values.push_back(v[u]);
    auto joined = std::make_shared<Samples>(v[before]);
    for (const double value : v[remembered].values) joined->values.push_back(value);
    const double sum = std::accumulate(joined->values.begin(), joined->values.end(), 0.0);
    v[y] = v[gain] * sum / static_cast<double>(joined->values.size());
    v.publish(all, std::shared_ptr<const Samples>(joined));
  }
  void on_sample(auto& v) const { v.next(hits) = v[hits] + 1.0; }
};

}  // namespace flyball::test
