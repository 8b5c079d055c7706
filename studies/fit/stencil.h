#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "studies/fit/unknowns.h"

namespace flyball {

/// Points around one, for central differences by parameters over their scales. Points out of the bounds are
/// left out.
class Stencil {
 public:
  enum class Order { value, gradient, hessian };

  Stencil(const std::vector<Unknown>& unknowns, std::span<const double> at, Order order);

  Order order() const { return order_; }
  /// The point itself comes first.
  const std::vector<std::vector<double>>& points() const { return points_; }

  /// From one value a point; NaN where there is none. One-sided where one side is missing, NaN where both
  /// are.
  Eigen::VectorXd gradient(const std::vector<double>& values) const;
  /// 0 where a value is missing.
  Eigen::MatrixXd hessian(const std::vector<double>& values) const;

 private:
  int add(std::span<const double> at, int i, double di, int j, double dj);
  double value(const std::vector<double>& values, int point) const;

  Order order_;
  std::vector<Unknown> unknowns_;
  std::vector<std::vector<double>> points_;
  std::vector<double> steps_;                // over the scales
  std::vector<int> plus_, minus_;            // numbers of points, of each parameter; -1 where it is left out
  std::vector<int> both_plus_, both_minus_;  // of each pair i < j, at i * n + j
};

}  // namespace flyball
