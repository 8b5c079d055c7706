#pragma once
#include "blocks/block.h"

namespace flyball {

struct Encoder : Block {
  static constexpr auto summary = "Counts the marks that a shaft has passed since the hit before.";
  SampleTime ts = sample_time(*Rational::fraction(1, 100));
  bool quantised = flag("quantised", true, "whole counts; else with their fractions");
  Param per_turn = param("counts_per_turn", 1000.0, "1", positive, "counts of a whole turn");
  Param initial = param("initial", 0.0, "rad", any, "angle from which it counts");
  Input angle = input("angle", "rad", "angle of the shaft");
  Output increment = output("increment", "1", "counts since the hit before");
  Output residual = output("residual", "1", "part of a count that has still to be counted");
  Held counted = held("counted", 0.0, "1", "counts up to the hit before");

  // Nothing is lost to rounding down: the residual of a hit is part of what the next one counts.
  void outputs(auto& v) const {
    v[increment] = count(v) - v[counted];
    v[residual] = quantised ? turned(v) - count(v) : v.number(0.0);
  }
  void on_sample(auto& v) const { v.next(counted) = count(v); }

 private:
  auto turned(auto& v) const { return (v[angle] - v[initial]) / (2.0 * M_PI) * v[per_turn]; }
  auto count(auto& v) const { return quantised ? floor(turned(v)) : turned(v); }
};

}  // namespace flyball
