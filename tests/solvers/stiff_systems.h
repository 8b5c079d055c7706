#pragma once

#include <algorithm>
#include <utility>

#include "tests/solvers/problems.h"

namespace flyball::test {

/// A system with its exact Jacobian: `jacobian(t, x, values)` in the order of `pattern`.
template <class F, class J>
class StiffSystem final : public FunctionSystem<double, F> {
 public:
  StiffSystem(Sparsity pattern, F f, J jacobian)
      : FunctionSystem<double, F>(pattern.size, std::move(f)),
        pattern_(std::move(pattern)),
        jacobian_(std::move(jacobian)) {}

  const Sparsity& pattern() const override { return pattern_; }
  void jacobian(double t, const double* x, double* values) override { jacobian_(t, x, values); }

 private:
  Sparsity pattern_;
  J jacobian_;
};

inline Sparsity dense_pattern(int n) {
  Sparsity pattern{n, {0}, {}};
  for (int c = 0; c < n; ++c) {
    for (int r = 0; r < n; ++r) pattern.row.push_back(r);
    pattern.start.push_back(static_cast<int>(pattern.row.size()));
  }
  return pattern;
}

inline Sparsity tridiagonal_pattern(int n) {
  Sparsity pattern{n, {0}, {}};
  for (int c = 0; c < n; ++c) {
    for (int r = std::max(c - 1, 0); r <= std::min(c + 1, n - 1); ++r) pattern.row.push_back(r);
    pattern.start.push_back(static_cast<int>(pattern.row.size()));
  }
  return pattern;
}

/// x1' = x2, x2' = -x1.
inline auto harmonic() {
  const auto rates = [](double, const double* x, double* dx) {
    dx[0] = x[1];
    dx[1] = -x[0];
  };
  const auto jacobian = [](double, const double*, double* values) {
    const double columns[] = {0.0, -1.0, 1.0, 0.0};
    std::copy(std::begin(columns), std::end(columns), values);
  };
  return StiffSystem(dense_pattern(2), rates, jacobian);
}

}  // namespace flyball::test
