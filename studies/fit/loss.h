#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace flyball {

/// How much a residual costs beyond its scale: rho(s) of its square s, rho(s) <= s.
/// squared: s; huber: s up to a^2, then 2 a sqrt(s) - a^2; soft_l1: 2 a^2 (sqrt(1 + s/a^2) - 1);
/// cauchy: a^2 log(1 + s/a^2).
class Loss {
 public:
  /// Throws std::invalid_argument where there is no loss of this name, or the scale is not above 0.
  Loss(const std::string& name, double scale);
  static const std::vector<std::string>& names();

  bool squared() const { return kind_ == Kind::squared; }
  double value(double s) const;
  double slope(double s) const;  // d rho/ds

  /// Replaces r and J, of `width` columns, by sqrt(rho') r and sqrt(rho') J, whose Gauss-Newton step is that
  /// of least squares with these weights, and whose gradient is that of the sum of rho/2. What this sum has
  /// more than the new residuals is the square of the result: a residual without derivatives. `jacobian` may
  /// be null.
  double apply(std::span<double> residuals, double* jacobian, std::size_t width) const;

 private:
  enum class Kind { squared, huber, soft_l1, cauchy };
  Kind kind_;
  double scale_;
};

}  // namespace flyball
