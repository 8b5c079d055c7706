#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "models/language/quantity.h"
#include "solvers/simulator.h"
#include "studies/metrics/measures.h"

namespace flyball {

/// An expression over columns of a log, time, and the results of calls.
struct SeriesExpression {
  struct Operand {
    enum class Kind { column, time, number, series };
    Kind kind = Kind::column;
    int index = 0;  // of a column; of a call whose result is a number, or a series
  };

  Formula formula;
  std::vector<Operand> operands;
  Quantity quantity;
  std::size_t begin = 0, end = 0;  // in the text

  /// Whether it has one value for a run.
  bool is_number() const;
};

/// For people: "1" for a number, empty where it is not known.
std::string unit_of(const Quantity& quantity);

/// A call of a measure. It only uses results of calls before it.
struct MeasureCall {
  const Measure* measure = nullptr;
  std::vector<std::optional<SeriesExpression>> arguments;  // by parameter
  std::optional<SeriesExpression> from, to;                // of a window of time [s]
  std::shared_ptr<const Polyline> path;
  Quantity quantity;
  std::size_t begin = 0;  // in the text

  /// Whether the last row is all that it reads of a log, and no statistics.
  bool reads_end_only() const { return measure->reads_end && !from && !to; }
};

/// The results of calls for one run, and the expressions over them.
class Evaluation {
 public:
  /// `calls`, `log` and `statistics` outlive it.
  Evaluation(const std::vector<MeasureCall>& calls, const Log& log, const RunStatistics& statistics);

  /// NaN where a run has no rows.
  double number(const SeriesExpression& expression) const;
  /// A value a row of the log.
  std::vector<double> series(const SeriesExpression& expression) const;
  /// The times of the rows [s].
  const std::vector<double>& time() const { return time_; }

 private:
  struct Result {
    double number = 0.0;
    std::vector<double> series;
  };

  Result result_of(const MeasureCall& call) const;
  double at(const SeriesExpression& expression, std::int64_t row) const;

  const Log& log_;
  const RunStatistics& statistics_;
  std::vector<double> time_;
  std::vector<Result> results_;
};

/// A signal between two times: interpolated at them, behind what happens at the first and before what happens
/// at the second, so that windows side by side share nothing. NaN: as far as the signal goes.
struct Window {
  double from, to;
};
void clip(std::vector<double>& time, std::vector<std::vector<double>>& values, const Window& window);

}  // namespace flyball
