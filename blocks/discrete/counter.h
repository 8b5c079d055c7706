#pragma once
#include "blocks/block.h"

namespace flyball {

struct Counter : Block {
  static constexpr auto summary = "Counts the edges of a signal.";
  int kind = option("direction", "rising", {"rising", "falling", "either"}, "which edges");
  bool resets = flag("reset", false, "an input `reset`, whose rise sets the count to `initial`");
  Param initial = param("initial", 0.0, "1", any, "count at the start");
  // Halfway between the two values of a switching signal, which never gets below 0.
  Param threshold = param("threshold", 0.5, "any", any, "level that the signals pass");
  Input u = input("u", "any", "signal");
  Input trigger = input_if(resets, "reset", "any", "sets the count to `initial`");
  Held count = held("count", initial, "1", "number of edges");
  Output y = output("y", count, "number of edges");
  Crossing edge = crossing("edge", static_cast<Direction>(kind), "the signal passes its threshold");
  Crossing clear = crossing_if(resets, "clear", Direction::rising, "`reset` rises through the threshold");

  void crossings(auto& v) const {
    v[edge] = v[u] - v[threshold];
    if (resets) v[clear] = v[trigger] - v[threshold];
  }
  void on_crossing(Crossing which, auto& v) const {
    v.next(count) = which == clear ? v[initial] : v[count] + 1.0;
  }
};

}  // namespace flyball
