#pragma once

#include <vector>

#include "models/plan.h"
#include "studies/language/study.h"

namespace flyball {

/// What was measured in one experiment [SI].
struct Measurements {
  std::vector<double> times;   // [s]; they do not fall
  std::vector<double> values;  // row by row, one a match
};

/// Reads the columns that an experiment is matched with. A unit in the header must have the dimension of the
/// logged signal. Throws FileError when the file cannot be read, FitError with all that is wrong with it.
Measurements read_measurements(const FitExperiment& experiment, const std::vector<LogColumn>& columns);

}  // namespace flyball
