#include "studies/fit/stencil.h"

#include <cmath>
#include <limits>

namespace flyball {

Stencil::Stencil(const std::vector<Unknown>& unknowns, std::span<const double> at, Order order)
    : order_(order), unknowns_(unknowns), points_{{at.begin(), at.end()}} {
  if (order == Order::value) return;
  const auto n = static_cast<int>(unknowns.size());
  std::vector<double> h;
  for (int i = 0; i < n; ++i) {
    h.push_back(unknowns[i].difference_step(at[i]));
    steps_.push_back(h[i] / unknowns[i].scale);
    plus_.push_back(add(at, i, h[i], i, 0.0));
    minus_.push_back(add(at, i, -h[i], i, 0.0));
  }
  if (order == Order::gradient) return;
  both_plus_.assign(static_cast<std::size_t>(n * n), -1);
  both_minus_ = both_plus_;
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j) {
      both_plus_[i * n + j] = add(at, i, h[i], j, h[j]);
      both_minus_[i * n + j] = add(at, i, -h[i], j, -h[j]);
    }
  }
}

int Stencil::add(std::span<const double> at, int i, double di, int j, double dj) {
  std::vector<double> point(at.begin(), at.end());
  point[i] += di;
  point[j] += dj;
  for (const int k : {i, j}) {
    if (point[k] < unknowns_[k].lower || point[k] > unknowns_[k].upper) return -1;
  }
  points_.push_back(std::move(point));
  return static_cast<int>(points_.size()) - 1;
}

double Stencil::value(const std::vector<double>& values, int point) const {
  return point < 0 ? std::numeric_limits<double>::quiet_NaN() : values[static_cast<std::size_t>(point)];
}

Eigen::VectorXd Stencil::gradient(const std::vector<double>& values) const {
  const auto n = static_cast<int>(unknowns_.size());
  Eigen::VectorXd result(n);
  for (int i = 0; i < n; ++i) {
    const double right = value(values, plus_[i]), left = value(values, minus_[i]);
    result[i] = (right - left) / (2.0 * steps_[i]);
    if (std::isnan(left)) result[i] = (right - values[0]) / steps_[i];
    if (std::isnan(right)) result[i] = (values[0] - left) / steps_[i];
  }
  return result;
}

Eigen::MatrixXd Stencil::hessian(const std::vector<double>& values) const {
  const auto n = static_cast<int>(unknowns_.size());
  const auto known = [](double x) { return std::isnan(x) ? 0.0 : x; };
  Eigen::MatrixXd result(n, n);
  for (int i = 0; i < n; ++i) {
    const double sides_i = value(values, plus_[i]) + value(values, minus_[i]);
    result(i, i) = known((sides_i - 2.0 * values[0]) / (steps_[i] * steps_[i]));
    for (int j = i + 1; j < n; ++j) {
      const double sides_j = value(values, plus_[j]) + value(values, minus_[j]);
      const double corners = value(values, both_plus_[i * n + j]) + value(values, both_minus_[i * n + j]);
      const double mixed = (corners - sides_i - sides_j + 2.0 * values[0]) / (2.0 * steps_[i] * steps_[j]);
      result(i, j) = result(j, i) = known(mixed);
    }
  }
  return result;
}

}  // namespace flyball
