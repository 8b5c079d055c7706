#pragma once

#include <Eigen/Dense>
#include <complex>
#include <string>
#include <vector>

#include "tests/blocks/bench.h"

namespace flyball::test {

/// A block's response C (sI - A)^-1 B + D at s from one input to one output, with the matrices taken from its
/// equations column by column: they are linear, so that the values at unit vectors are the columns.
inline std::complex<double> response(Device& d, const std::vector<std::string>& states,
                                     const std::string& input, const std::string& output,
                                     std::complex<double> s) {
  const int n = static_cast<int>(states.size());
  Eigen::MatrixXcd A(n, n);
  Eigen::VectorXcd B(n);
  Eigen::RowVectorXcd C(n);
  const auto probe = [&](const std::string& name, auto&& column, std::complex<double>& gain) {
    d[name] = 1.0;
    d.update();
    for (int i = 0; i < n; ++i) column(i) = d.rate(states[i]);
    gain = d[output];
    d[name] = 0.0;
  };
  for (int k = 0; k < n; ++k) probe(states[k], A.col(k), C(k));
  std::complex<double> D;
  probe(input, B, D);
  const Eigen::MatrixXcd resolvent = s * Eigen::MatrixXcd::Identity(n, n) - A;
  return (C * resolvent.fullPivLu().solve(B))(0) + D;
}

}  // namespace flyball::test
