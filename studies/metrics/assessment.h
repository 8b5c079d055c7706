#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "studies/metrics/requirement.h"

namespace flyball {

struct MetricResult {
  std::string name, text;
  std::string unit;    // SI; "1" for a number, empty where it is not known
  double value = 0.0;  // NaN: the run has no answer
};

struct RequirementResult {
  std::string name, text;
  std::string unit;  // of margin and value
  Verdict verdict;
};

/// What a run says to all that it was asked.
struct Assessment {
  std::vector<MetricResult> metrics;
  std::vector<RequirementResult> requirements;

  bool empty() const { return metrics.empty() && requirements.empty(); }
  long failed() const {
    return std::ranges::count_if(requirements, [](const auto& each) { return !each.verdict.passed; });
  }
};

}  // namespace flyball
