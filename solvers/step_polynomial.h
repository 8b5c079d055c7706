#pragma once

#include <vector>

#include "solvers/extension.h"
#include "solvers/workspace.h"

namespace flyball {

/// Signals inside one step, where they are affine in the states and the step has an Extension: polynomials of
/// its degree. A constant stays exactly constant.
class StepPolynomial {
 public:
  explicit StepPolynomial(int signals) : terms_(signals) {}

  /// For the signals that `map` tells, in its order.
  void fit(const Workspace<double>::Affine& map, const Extension<double>& states);

  int signals() const { return static_cast<int>(terms_.size()); }
  double value(int signal, double t) const {
    const double theta = (t - begin_) * scale_, rest = 1.0 - theta;
    const Terms& s = terms_[signal];
    return s.start + theta * (s.chord + rest * (s.first + theta * (s.last + rest * s.bubble)));
  }
  double slope(int signal, double t) const {
    const double theta = (t - begin_) * scale_;
    const Terms& s = terms_[signal];
    const double square = s.last - s.first + s.bubble, cube = -s.last - 2.0 * s.bubble;
    return scale_ *
           (s.chord + s.first + theta * (2.0 * square + theta * (3.0 * cube + theta * 4.0 * s.bubble)));
  }

 private:
  struct Terms {
    double start, chord, first, last, bubble;
  };

  std::vector<Terms> terms_;
  double begin_ = 0.0, scale_ = 0.0;
};

}  // namespace flyball
