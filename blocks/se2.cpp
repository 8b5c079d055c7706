#include "blocks/se2.h"

namespace flyball {

// Below this the first terms of the series are exact to rounding: the next one of sinc is x^10/11! = 2e-18.
constexpr double small = 0.1;

double sinc_value(double x) {
  if (std::fabs(x) >= small) return std::sin(x) / x;
  const double y = x * x;
  return 1.0 - y / 6.0 * (1.0 - y / 20.0 * (1.0 - y / 42.0 * (1.0 - y / 72.0)));
}

double sinc_slope(double x) {
  if (std::fabs(x) >= small) return (std::cos(x) - std::sin(x) / x) / x;
  const double y = x * x;
  return -x / 3.0 * (1.0 - y / 10.0 * (1.0 - y / 28.0 * (1.0 - y / 54.0)));
}

double saturated_asin_value(double x) { return std::asin(std::clamp(x, -1.0, 1.0)); }

double saturated_asin_slope(double x) { return std::fabs(x) < 1.0 ? 1.0 / std::sqrt(1.0 - x * x) : 0.0; }

}  // namespace flyball
