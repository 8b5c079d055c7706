#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "studies/metrics/metric.h"

namespace flyball {

/// What a run says to a requirement.
struct Verdict {
  bool passed = false;
  /// How far from being broken, in the quantity's own unit; negative where it is broken. NaN where the run
  /// gives no number, which does not pass.
  double margin = 0.0;
  double value = 0.0;   // of the metric; of the signal where it is worst
  double time = 0.0;    // of the worst [s]; NaN for a metric
  std::string message;  // one line: what was found against what was wanted
};

/// What makes a run good: "overshoot(y) < 5 %", "always abs(u) <= 12 V", "y within envelope.csv",
/// "y matches baseline.csv (absolute 1 mm, relative 1 %, time 10 ms)". docs/guide/requirements.md has the
/// forms.
class Requirement {
 public:
  /// Files are found from `folder`. Throws TextError; a file that cannot be read or used is one, too.
  Requirement(std::string_view text, const std::vector<LogColumn>& columns,
              const std::filesystem::path& folder);

  Verdict check(const Log& log, const RunStatistics& statistics = {}) const;
  const std::string& text() const;
  const std::string& unit() const;  // of margin and value
  bool reads_end_only() const;

 private:
  struct Program;
  std::shared_ptr<const Program> program_;
};

}  // namespace flyball
