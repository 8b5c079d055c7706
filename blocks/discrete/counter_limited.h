#pragma once
#include "blocks/block.h"

namespace flyball {

struct CounterLimited : Block {
  static constexpr auto summary = "Counts sample hits from 0 up to a limit, and begins again.";
  static constexpr std::array aliases{"Modulo_Count"};
  SampleTime ts = sample_time();
  Param upper = param("upper", 7.0, "1", non_negative, "last count before 0");
  Output y = output("y", "1", "the count");
  Held count = held("count", 0.0, "1", "count at the next hit");
  Relation full = relation("full", "the next count would pass the limit");

  // Counts are whole: half a count keeps the comparison away from equality.
  void relations(auto& v) const { v[full] = v[count] + 0.5 - v[upper]; }
  void outputs(auto& v) const { v[y] = v[count]; }
  void on_sample(auto& v) const { v.next(count) = select(v.on(full), v.number(0.0), v[count] + 1.0); }
};

}  // namespace flyball
