#pragma once

#include <vector>

#include "models/sparsity.h"
#include "solvers/sundials.h"

namespace flyball::sundials {

/// The matrix of CVODE's Newton iteration and its solver: dense for few states, sparse for many.
class NewtonMatrix {
 public:
  /// Attaches matrix and solver to `cvode`, whose user data `jacobian` knows; `state` is a model vector.
  void attach(void* cvode, N_Vector state, const Sparsity& pattern, CVLsJacFn jacobian);

  /// Writes the Jacobian that `evaluate(values)` gives in the order of the pattern.
  template <class Evaluate>
  void fill(SUNMatrix matrix, const Sparsity& pattern, Evaluate&& evaluate) {
    double* values = begin_fill(matrix, pattern);
    evaluate(values);
    end_fill(matrix, pattern);
  }

 private:
  double* begin_fill(SUNMatrix matrix, const Sparsity& pattern);
  void end_fill(SUNMatrix matrix, const Sparsity& pattern) const;

  bool sparse_ = false;
  Matrix matrix_;
  LinearSolver linear_;
  std::vector<double> entries_;  // of a dense matrix, in the order of the pattern
};

}  // namespace flyball::sundials
