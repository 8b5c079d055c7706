#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "blocks/time_series.h"

namespace flyball {

/// Limits of a signal over time: two curves, straight between their points, and how far a signal may leave
/// them.
struct Tube {
  std::optional<TimeSeries> lower, upper;
  double absolute = 0.0;  // in the signal's unit
  double relative = 0.0;  // part of the curve's own size
  double time = 0.0;      // s: the curves may come so much early or late
  bool whole = false;     // the signal must go as far as the curves do

  const TimeSeries& any() const { return lower ? *lower : *upper; }
};

/// The tube at one time. Where a curve jumps, the looser side holds.
struct TubeLimits {
  double lower, upper;
};

/// Limits at times that never fall.
class TubeReader {
 public:
  explicit TubeReader(const Tube& tube) : tube_(tube) {}
  TubeLimits at(double time);

 private:
  /// The largest of `sign` times a curve within a span of time that only moves on.
  struct Largest {
    const TimeSeries* curve;
    double sign;
    std::size_t next = 0;  // of the curve, beyond the span
    std::size_t first = 0;
    std::vector<std::size_t> candidates = {};  // from `first` on: falling values

    double within(double from, double to);
    double edge(double time) const;
  };

  const Tube& tube_;
  Largest low_{tube_.lower ? &*tube_.lower : nullptr, -1.0};
  Largest high_{tube_.upper ? &*tube_.upper : nullptr, 1.0};
};

/// Reads the columns lower and upper, or one of them, over the first column, time. Throws std::runtime_error.
Tube read_envelope(const std::filesystem::path& file);
/// Reads one column as both limits. An empty name: the only one besides time. Throws std::runtime_error.
Tube read_baseline(const std::filesystem::path& file, const std::string& column);

}  // namespace flyball
