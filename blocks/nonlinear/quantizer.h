#pragma once
#include "blocks/block.h"

namespace flyball {

struct Quantizer : Block {
  static constexpr auto summary = "Rounds its input to whole multiples of an interval.";
  static constexpr std::array aliases{"QUANT_f"};
  Param interval = param("interval", 0.5, "any", positive, "distance between two levels");
  Input u = input("u", "any", "signal");
  Output y = output("y", "any", "the nearest multiple");
  Held level = held("level", 0.0, "1", "which multiple");
  Relation above = relation("above", "the signal is nearer to a higher level");
  Relation below = relation("below", "the signal is nearer to a lower level");
  Crossing rises = crossing("rises", Direction::rising, "the signal passes into a higher level");
  Crossing falls = crossing("falls", Direction::falling, "the signal passes into a lower level");

  void relations(auto& v) const {
    v[above] = v[u] - upper(v);
    v[below] = lower(v) - v[u];
  }
  void crossings(auto& v) const {
    v[rises] = v[u] - upper(v);
    v[falls] = v[u] - lower(v);
  }
  // Where the signal jumps, the level follows by value, over any number of levels; where it was located at
  // the edge of a level, rounding must not bring the old one back.
  void on_crossing(Crossing which, auto& v) const {
    v.next(level) =
        whole(which == rises ? max(multiple(v), v[level] + 1.0) : min(multiple(v), v[level] - 1.0));
  }
  // The level changes at the end of an instant; those who read y within it see the new one already.
  void outputs(auto& v) const {
    v[y] = v[interval] * select(either(v.on(above), v.on(below)), whole(multiple(v)), v[level]);
  }

 private:
  static auto whole(const auto& x) { return floor(x + 0.5); }
  auto multiple(auto& v) const { return v[u] / v[interval]; }
  auto upper(auto& v) const { return (v[level] + 0.5) * v[interval]; }
  auto lower(auto& v) const { return (v[level] - 0.5) * v[interval]; }
};

}  // namespace flyball
