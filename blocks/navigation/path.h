#pragma once

#include <cmath>
#include <vector>

namespace flyball {

/// Points in the plane, m, that a robot drives to one after the other; the first is where it begins. At least
/// two, so that there is a way. `theta[k]` is the direction of the way to point k, of the first one that of
/// the way from it.
struct Path {
  std::vector<double> x{0.0, 1.0};
  std::vector<double> y{0.0, 0.0};
  std::vector<double> theta{0.0, 0.0};

  Path() = default;
  /// NumberRows of x and y.
  explicit Path(const std::vector<std::vector<double>>& points) : x{}, y{}, theta{} {
    for (const auto& point : points) {
      x.push_back(point[0]);
      y.push_back(point[1]);
    }
    theta.resize(points.size());
    for (int k = 1; k <= last(); ++k) theta[k] = std::atan2(y[k] - y[k - 1], x[k] - x[k - 1]);
    theta[0] = theta[1];
  }

  int last() const { return static_cast<int>(x.size()) - 1; }
};

}  // namespace flyball
