#pragma once
#include "blocks/block.h"

namespace flyball {

struct PulseGenerator : Block {
  static constexpr auto summary = "Rectangular pulses at regular times.";
  static constexpr std::array aliases{"Modelica.Blocks.Sources.Pulse", "PULSE_SC"};
  Param amplitude = param("amplitude", 1.0, "any", any, "value during a pulse; 0 between pulses");
  Param period = param("period", 1.0, "s", positive, "time from one pulse to the next");
  Param duty = param("duty", 0.5, "1", {0.0, 1.0, true, true}, "width of a pulse over the period");
  Param delay = param("delay", 0.0, "s", non_negative, "time of the first pulse");
  Output y = output("y", "any", "the value");
  // Edges are counted, not added up, so that pulse k starts at delay + k*period however large k is.
  Held pulses = held("pulses", 0.0, "1", "number of pulses that have begun");
  Held high = held("high", 0.0, "1", "1 during a pulse");
  Alarm edge = alarm("edge", "the next start or end of a pulse");

  void schedule(auto& v) const {
    const auto start = v[delay] + v[pulses] * v[period];
    const auto end = v[delay] + (v[pulses] - 1.0 + v[duty]) * v[period];
    v[edge] = select(v.on(high), end, start);
  }
  void on_time(auto& v) const {
    v.next(pulses) = select(v.on(high), v[pulses], v[pulses] + 1.0);
    v.next(high) = 1.0 - v[high];
  }
  void outputs(auto& v) const { v[y] = select(v.on(high), v[amplitude], v.number(0.0)); }
};

}  // namespace flyball
