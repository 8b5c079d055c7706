#include "studies/fit/loss.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace flyball {

const std::vector<std::string>& Loss::names() {
  static const std::vector<std::string> all = {"squared", "huber", "soft_l1", "cauchy"};
  return all;
}

Loss::Loss(const std::string& name, double scale) : scale_(scale) {
  const auto found = std::ranges::find(names(), name);
  if (found == names().end())
    throw std::invalid_argument(
        fmt::format("there is no loss \"{}\"; known: {}", name, fmt::join(names(), ", ")));
  if (!(scale > 0.0))
    throw std::invalid_argument(fmt::format("the scale of a loss is {}, expected a number above 0", scale));
  kind_ = static_cast<Kind>(found - names().begin());
}

double Loss::value(double s) const {
  const double a = scale_ * scale_;
  switch (kind_) {
    case Kind::squared:
      return s;
    case Kind::huber:
      return s <= a ? s : 2.0 * scale_ * std::sqrt(s) - a;
    case Kind::soft_l1:
      return 2.0 * s / (std::sqrt(1.0 + s / a) + 1.0);
    case Kind::cauchy:
      return a * std::log1p(s / a);
  }
  return s;
}

double Loss::slope(double s) const {
  const double a = scale_ * scale_;
  switch (kind_) {
    case Kind::squared:
      return 1.0;
    case Kind::huber:
      return s <= a ? 1.0 : scale_ / std::sqrt(s);
    case Kind::soft_l1:
      return 1.0 / std::sqrt(1.0 + s / a);
    case Kind::cauchy:
      return 1.0 / (1.0 + s / a);
  }
  return 1.0;
}

double Loss::apply(std::span<double> residuals, double* jacobian, std::size_t width) const {
  if (squared()) return 0.0;
  double more = 0.0;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    const double s = residuals[i] * residuals[i], weight = slope(s), root = std::sqrt(weight);
    more += value(s) - weight * s;
    residuals[i] *= root;
    for (std::size_t p = 0; jacobian != nullptr && p < width; ++p) jacobian[i * width + p] *= root;
  }
  return std::sqrt(std::max(more, 0.0));
}

}  // namespace flyball
