#pragma once
#include "blocks/block.h"

namespace flyball {

struct HitCrossing : Block {
  static constexpr auto summary = "Finds when its input crosses a level, and marks it by a pulse.";
  static constexpr std::array aliases{"Modelica.Blocks.Logical.ZeroCrossing", "ZCROSS_f"};
  int direction =
      option("direction", "either", {"either", "rising", "falling"}, "which passage of the level is a hit");
  Param offset = param("offset", 0.0, "any", any, "the level");
  // Without a width, a pulse would be over before anyone sees it: an instant takes no time.
  Param width = param("width", 1e-3, "s", positive, "how long the pulse of a hit lasts");
  Input u = input("u", "any", "signal");
  Held high = held("high", 0.0, "1", "1 from a hit until the pulse is over");
  Held end = held("end", 0.0, "s", "when the pulse is over");
  Held count = held("count", 0.0, "1", "number of hits so far");
  Output y = output("y", high, "1 from a hit until the pulse is over, else 0");
  Output hits = output("hits", count, "number of hits so far");
  Relation above = relation("above", "the signal is above the level");
  // In both directions: what begins beyond the level has not crossed it.
  Crossing passes = crossing("passes", Direction::either, "the signal passes the level");
  Alarm over = alarm("over", "the end of the pulse");

  void relations(auto& v) const { v[above] = v[u] - v[offset]; }
  void crossings(auto& v) const { v[passes] = v[u] - v[offset]; }
  void on_crossing(Crossing, auto& v) const {
    v.next(high) = if_hit(v, v.number(1.0), v[high]);
    v.next(end) = if_hit(v, v.time() + v[width], v[end]);
    v.next(count) = if_hit(v, v[count] + 1.0, v[count]);
  }
  void schedule(auto& v) const { v[over] = select(v.on(high), v[end], never); }
  void on_time(auto& v) const { v.next(high) = 0.0; }

 private:
  auto if_hit(auto& v, const auto& hit, const auto& none) const {
    const auto rising = direction == 2 ? none : hit, falling = direction == 1 ? none : hit;
    return select(v.on(above), rising, falling);
  }
};

}  // namespace flyball
