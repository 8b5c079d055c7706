#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "solvers/simulator.h"
#include "studies/metrics/polyline.h"
#include "studies/metrics/signal_metrics.h"

namespace flyball {

/// A parameter of a measure.
struct MeasureParameter {
  enum class Kind {
    signal,     // an expression over logged signals; of the first one's dimension
    plain,      // the same, a number or an angle
    condition,  // a comparison of such
    level,      // a number of the first signal's dimension
    number,     // a plain number
    time,       // a number of seconds
    path        // the name of a CSV file of points
  };
  static bool over_time(Kind kind) {
    return kind == Kind::signal || kind == Kind::plain || kind == Kind::condition;
  }

  std::string_view name;
  Kind kind = Kind::signal;
  bool required = true;
};

/// What a measure gets: signals (conditions are 1 or 0) on the grid of the log or of the window that was
/// asked for, and a number for each parameter, NaN where none was given.
struct MeasureInput {
  std::vector<Signal> signals;  // those that were given
  std::vector<double> numbers;
  const Polyline* path = nullptr;
  const RunStatistics* statistics = nullptr;

  const Signal& first() const { return signals.front(); }
  double number(std::size_t parameter, double fallback) const {
    return numbers[parameter] == numbers[parameter] ? numbers[parameter] : fallback;
  }
};

/// A function that makes one number of a run, or another signal.
struct Measure {
  std::string_view name;
  std::string_view doc;
  std::vector<MeasureParameter> parameters;
  // Dimension of the result: that of the first signal to this power, times seconds to that one.
  int power = 0, seconds = 0;
  double (*value)(const MeasureInput& input) = nullptr;
  bool reads_end = false;  // nothing but the last row
  /// Where there is no value: the signal, on the same grid.
  std::vector<double> (*series)(const MeasureInput& input) = nullptr;

  /// "settling(y[, band, final, initial])"
  std::string signature() const;
};

/// All measures, in the order of the documentation.
const std::vector<Measure>& measures();

/// By name, whose case does not count: the field writes IAE. nullptr when there is none.
const Measure* find_measure(std::string_view name);

}  // namespace flyball
