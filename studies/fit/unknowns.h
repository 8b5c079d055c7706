#pragma once

#include <string>
#include <vector>

#include "models/plan.h"
#include "studies/language/study.h"

namespace flyball {

/// A parameter that a fit looks for [SI]. The solver sees it divided by its scale.
struct Unknown {
  std::string name;
  std::string unit;
  double start = 0.0;
  double lower = 0.0, upper = 0.0;  // what the user and the model allow; may be infinite
  double scale = 1.0;

  /// Of a difference at this value: 3e-4 of it. Simulations at a tolerance of 1e-10 leave 3e-7 of noise in a
  /// central difference so, and curvature an error of the order of 1e-7.
  double difference_step(double value) const;
};

/// Checks what is sought against a model. Throws FitError with all that is wrong, a line each, each after
/// `prefix`.
std::vector<Unknown> unknowns_of(const std::vector<Sought>& sought, const Plan& plan,
                                 const std::string& prefix);

}  // namespace flyball
