#pragma once

#include <span>
#include <string>
#include <vector>

#include "studies/fit/fit.h"

namespace flyball {

/// What residuals of data and their Jacobian say of the parameters that were found.
struct DataFit {
  std::span<const double> residuals;
  std::span<const double> jacobian;  // by the parameters over their scales, row by row
  std::span<const double> scales;
  bool exact = true;  // whether the Jacobian has no error of differences
};

/// Fills in standard errors, correlation and condition of a result whose parameters have their values, and
/// remarks in words on what the data do not tell. The parameters' covariance is s^2 (J'J)^-1, where s^2 is
/// the sum of squares over the number of residuals less that of parameters; parameters at a bound, and those
/// without influence, count as known.
void identify(const DataFit& fit, FitResult& result);

}  // namespace flyball
