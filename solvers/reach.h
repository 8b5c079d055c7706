#pragma once

#include <cmath>
#include <limits>

namespace flyball {

/// How far the next step goes.
struct Reach {
  double size = 0.0;
  bool lands = false;      // ends on the limit
  bool shortened = false;  // by the limit, not by the error: says nothing about the size to remember
};

/// The step of about `wanted` (at most `max_step`) that leaves no tiny rest before a limit `remaining` away:
/// what is 1 % too far is stretched to, what is less than two steps away is halved. (1 %: E. Hairer's
/// dopri5.f. A rest of 1e-10 is rounding, and may exceed max_step.)
inline Reach reach(double wanted, double remaining, double max_step) {
  const bool rounding = remaining <= wanted * (1.0 + 1e-10);
  const bool stretch = remaining <= 1.01 * wanted && remaining <= max_step;
  if (rounding || stretch) return {remaining, true, remaining < wanted};
  if (remaining < 2.0 * wanted) return {0.5 * remaining, false, true};
  return {wanted, false, false};
}

/// A step below this one is lost in the rounding of `time`: 16 units in the last place.
inline double vanishing_step(double time) {
  const double t = std::fabs(time);
  return 16.0 * (std::nextafter(t, std::numeric_limits<double>::infinity()) - t);
}

}  // namespace flyball
