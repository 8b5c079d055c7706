#pragma once
#include "blocks/block.h"

namespace flyball {

/// What blocks share that judge a run by the size of an error at their hits.
struct RunningTerms : Block {
  std::string unit;
  Input ignored = input("ignore", "1", "1 leaves this hit out of mean, rms and largest", 0.0);
  Output mean = output("mean", unit, "mean over the hits so far");
  Output rms = output("rms", unit, "root of the mean square over the hits so far");
  Output largest = output("largest", unit, "largest at the hits so far");
  Held hits = held("hits", 0.0, "1", "number of hits that count");
  Held sum = held("sum", 0.0, unit, "sum over them");
  Held squares = held("squares", 0.0, "any", "sum of squares over them");
  Held top = held("top", 0.0, unit, "largest at them");

  RunningTerms(Settings* settings, std::string of_error) : Block(settings), unit(std::move(of_error)) {}

  /// Writes the outputs; `error` is not below 0, and `counts` 1 or 0.
  void show(auto& v, const auto& error, const auto& counts) const {
    const auto n = max(v[hits] + counts, v.number(1.0));
    v[mean] = (v[sum] + counts * error) / n;
    // The root of 0 has no derivative.
    const auto more = counts * error;
    v[rms] = sqrt((max(v[squares], v.number(0.0)) + more * more) / n + smallest);
    v[largest] = max(v[top], counts * error);
  }
  void keep(auto& v, const auto& error, const auto& counts) const {
    v.next(hits) = v[hits] + counts;
    v.next(sum) = v[sum] + counts * error;
    v.next(squares) = v[squares] + counts * error * error;
    v.next(top) = v[largest];
  }
  auto counted(auto& v) const { return 1.0 - v[ignored]; }
};

}  // namespace flyball
