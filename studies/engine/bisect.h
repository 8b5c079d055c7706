#pragma once

#include <limits>
#include <string>
#include <vector>

#include "studies/engine/evaluator.h"

namespace flyball {

/// Where a requirement begins to be broken, for one case in one scenario.
struct BisectLimit {
  int choice = 0;  // number in the cases
  int scenario = 0;
  /// The middle of the last interval, which is at most as long as the tolerance [SI]. NaN where the ends of
  /// the range say the same.
  double value = std::numeric_limits<double>::quiet_NaN();
  double holds = 0.0;   // end of that interval where the requirement holds
  double broken = 0.0;  // and where it is broken
  int runs = 0;
  std::string reason;  // of NaN, in words
};

struct BisectResult {
  std::string name;
  std::string parameter;
  std::vector<BisectLimit> limits;  // by case, then by scenario
};

/// Halves the range of [bisect.NAME] for each case in each scenario. A run that is stopped breaks the
/// requirement. `cases` are those of the study with what fits and fronts have found filled in.
BisectResult run_bisect(const Study& study, const BisectDefinition& definition,
                        const std::vector<Choice>& cases, Evaluator& evaluator,
                        const EvaluatorOptions& options = {});

}  // namespace flyball
