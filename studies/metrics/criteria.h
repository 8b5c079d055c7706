#pragma once

#include <string>
#include <utility>
#include <vector>

#include "models/language/diagnostics.h"
#include "models/plan.h"
#include "studies/metrics/assessment.h"
#include "studies/run.h"

namespace flyball {

/// What a run is asked: metrics and requirements by name.
struct Criteria {
  std::vector<std::pair<std::string, Metric>> metrics;
  std::vector<std::pair<std::string, Requirement>> requirements;

  bool empty() const { return metrics.empty() && requirements.empty(); }
};

/// Those of the model's own sections [metrics] and [requirements]. Reports all that is wrong with them, where
/// it stands in the file.
Criteria read_criteria(const Plan& plan, Diagnostics& diagnostics);

/// A run that did not come to its end has no metrics, and keeps no requirement.
Assessment assess(const Criteria& criteria, const RunResult& result);

}  // namespace flyball
