#include "studies/fit/quadratic_residuals.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace flyball {
namespace {

/// A direction without curvature keeps this part of the largest one, or of the one that the slope asks for.
constexpr double least_curvature = 1e-6;

}  // namespace

QuadraticResiduals::QuadraticResiduals(double value, const Eigen::VectorXd& gradient,
                                       const Eigen::MatrixXd& hessian)
    : residuals(Eigen::VectorXd::Zero(gradient.size() + 1)),
      jacobian(Eigen::MatrixXd::Zero(gradient.size() + 1, gradient.size())) {
  const Eigen::Index n = gradient.size();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(hessian);
  Eigen::VectorXd curvature = eigen.eigenvalues().cwiseAbs();
  const double steepness = value > 0.0 ? gradient.squaredNorm() / value : 0.0;
  const double least = least_curvature * std::max(curvature.maxCoeff(), steepness);
  curvature = curvature.cwiseMax(least + std::numeric_limits<double>::min());
  const Eigen::VectorXd along = eigen.eigenvectors().transpose() * gradient;
  const double drop = 0.5 * (along.array().square() / curvature.array()).sum();
  if (drop > value) curvature *= value > 0.0 ? drop / value : 1.0;
  const Eigen::VectorXd root = (0.5 * curvature).cwiseSqrt();
  jacobian.topRows(n) = root.asDiagonal() * eigen.eigenvectors().transpose();
  if (!(value > 0.0)) return;
  residuals.head(n) = 0.5 * along.cwiseQuotient(root);
  residuals[n] = std::sqrt(std::max(value - std::min(drop, value), 0.0));
}

}  // namespace flyball
