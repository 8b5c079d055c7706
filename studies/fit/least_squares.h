#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace flyball {

/// Residuals and, where `jacobian` is not null, their derivatives, row by row, at `x`. False where there are
/// none: the solver then takes a shorter step.
using ResidualFunction = std::function<bool(std::span<const double> x, double* residuals, double* jacobian)>;

struct LeastSquaresProblem {
  ResidualFunction evaluate;
  int residuals = 0;
  std::vector<double> start, lower, upper;  // bounds may be infinite
  int max_iterations = 100;
  std::function<bool(int iteration, double cost)> progress = {};  // false ends the search
};

struct LeastSquaresSolution {
  std::vector<double> x;
  bool converged = false;
  bool interrupted = false;
  std::string reason;
  double cost_before = 0.0, cost = 0.0;  // half the sum of squares; NaN where the start has no residuals
  int iterations = 0;
};

/// The Levenberg-Marquardt method of Ceres on dense matrices. It ends where the cost falls by less than 1e-15
/// of itself, or unknowns move by less than 1e-10 of their length: they should be of the order of 1.
LeastSquaresSolution minimise(const LeastSquaresProblem& problem);

}  // namespace flyball
