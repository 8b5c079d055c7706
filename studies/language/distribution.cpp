#include <algorithm>
#include <cmath>

#include "studies/language/sampling.h"

namespace flyball {
namespace {

/// The part of a standard normal distribution below z.
double normal_part(double z) { return 0.5 * std::erfc(-z * M_SQRT1_2); }

/// The quantile of the part of a standard normal distribution between two ends. Above the mean it is
/// mirrored, because parts near 1 are not told apart.
double truncated_normal(double p, double lower, double upper) {
  if (lower > 0.0) return -truncated_normal(1.0 - p, -upper, -lower);
  const double below = normal_part(lower), inside = normal_part(upper) - below;
  const double part = below + p * inside;
  if (part <= 0.0 || part >= 1.0) return part <= 0.0 ? lower : upper;
  return std::clamp(normal_quantile(part), lower, upper);
}

double triangular(double p, double lower, double upper, double mode) {
  const double rising = (mode - lower) / (upper - lower);
  if (p < rising) return lower + std::sqrt(p * (upper - lower) * (mode - lower));
  return upper - std::sqrt((1.0 - p) * (upper - lower) * (upper - mode));
}

}  // namespace

// The rational starting value of M. J. Wichura's AS 241 to seven digits (Applied Statistics 37, 1988), and a
// step of Halley's method.
double normal_quantile(double p) {
  if (p > 0.5) return -normal_quantile(1.0 - p);
  double z = 0.0;
  if (const double q = p - 0.5; q > -0.425) {
    const double r = 0.180625 - q * q;
    z = q * (((59.109374720 * r + 159.29113202) * r + 50.434271938) * r + 3.3871327179) /
        (((67.187563600 * r + 78.757757664) * r + 17.895169469) * r + 1.0);
  } else {
    const double r = std::sqrt(-std::log(p));
    if (r <= 5.0) {
      const double s = r - 1.6;
      z = -(((0.17023821103 * s + 1.3067284816) * s + 2.7568153900) * s + 1.4234372777) /
          ((0.12021132975 * s + 0.73700164250) * s + 1.0);
    } else {
      const double s = r - 5.0;
      z = -(((0.017337203997 * s + 0.42868294337) * s + 3.0812263860) * s + 6.6579051150) /
          ((0.012258202635 * s + 0.24197894225) * s + 1.0);
    }
  }
  const double step = (normal_part(z) - p) * std::sqrt(2.0 * M_PI) * std::exp(0.5 * z * z);
  return z - step / (1.0 + 0.5 * z * step);
}

double Distribution::quantile(double p) const {
  switch (kind) {
    case Kind::uniform:
      return a + (b - a) * p;
    case Kind::normal:
      if (!lowest || !highest) return a + b * normal_quantile(p);
      return std::clamp(a + b * truncated_normal(p, (*lowest - a) / b, (*highest - a) / b), *lowest,
                        *highest);
    case Kind::lognormal: {
      const double scale = std::log(b);
      if (!lowest || !highest) return a * std::exp(scale * normal_quantile(p));
      const auto z = [&](double x) { return x <= 0.0 ? -infinity : std::log(x / a) / scale; };
      return std::clamp(a * std::exp(scale * truncated_normal(p, z(*lowest), z(*highest))), *lowest,
                        *highest);
    }
    case Kind::triangular:
      return triangular(p, a, b, c);
    case Kind::choice: {
      const double at = std::floor(p * static_cast<double>(values.size()));
      return values[std::min(static_cast<std::size_t>(at), values.size() - 1)];
    }
  }
  return a;
}

}  // namespace flyball
