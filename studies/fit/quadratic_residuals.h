#pragma once

#include <Eigen/Core>

namespace flyball {

/// A quantity m >= 0 of n parameters, that is no sum of squares by itself, for a least-squares solver:
/// n + 1 residuals r and their Jacobian J with r'r = m, J'r = g/2 and J'J = H/2, where g is the gradient of m
/// and H its Hessian with eigenvalues made positive. The solver's step is then that of Newton's method.
///
/// One residual sqrt(m) would have a Jacobian of rank one, which vanishes where m is least: the solver would
/// know nothing of how m bends there.
///
/// Where m - g'H^-1 g/2, the least value that this parabola promises, is below 0, H is enlarged until it is
/// 0.
struct QuadraticResiduals {
  QuadraticResiduals(double value, const Eigen::VectorXd& gradient, const Eigen::MatrixXd& hessian);

  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;
};

}  // namespace flyball
