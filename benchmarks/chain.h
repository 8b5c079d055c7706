#pragma once

#include <vector>

#include "benchmarks/workload.h"

namespace flyball::bench {

/// x_i' = k_i (x_{i-1} - 2 x_i + x_{i+1}), i = 1..N, x_0 = 1, x_{N+1} = 0, from rest; k_i = k (1 + 0.5 sin
/// i). As the shipped generator writes it.
struct Chain {
  std::vector<double> k;
  static constexpr double stop = 1.0;

  Chain(int sections, double stiffness);
  int size() const { return static_cast<int>(k.size()); }
  void rates(const double* x, double* dx) const;
};

/// The state at the stop time by Dormand-Prince, stages and rates fused into one pass each.
std::vector<double> solve_chain_dopri5(const Chain& chain, double rtol, double atol);

/// The same by CVODE's BDF with KLU and the tridiagonal Jacobian.
std::vector<double> solve_chain_bdf(const Chain& chain, double rtol, double atol);

}  // namespace flyball::bench
