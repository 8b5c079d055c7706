#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "models/language/text_error.h"
#include "solvers/simulator.h"

namespace flyball {

/// A number that sums up a run: "overshoot(y)", "settling(y, 2 %)", "integral(u^2)", "final(x) +
/// 2*max(abs(u))". An expression of the model language over functions of logged signals, whose arguments are
/// expressions over logged signals and time. docs/guide/metrics.md lists the functions.
class Metric {
 public:
  /// Files, such as the path of cross_track, are found from `folder`. Throws TextError: a signal or a
  /// function that is not there, a missing argument, dimensions that contradict.
  Metric(std::string_view text, const std::vector<LogColumn>& columns,
         const std::filesystem::path& folder = {});

  /// NaN where the run has no answer: a signal that did not settle. `statistics` serve steps(),
  /// evaluations(), hits() and events().
  double evaluate(const Log& log, const RunStatistics& statistics = {}) const;
  /// In SI; "1" for a number, empty where it is not known.
  const std::string& unit() const;
  const std::string& text() const;
  /// Whether the last row of the log is all that it reads, and no statistics.
  bool reads_end_only() const;

 private:
  struct Program;
  std::shared_ptr<const Program> program_;
};

}  // namespace flyball
