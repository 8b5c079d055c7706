#pragma once

#include <algorithm>
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

/// A step below this one leads nowhere: it is lost in the rounding of `time` (16 units in the last place),
/// or, near time 0 where rounding knows no limit, a run of steps like it would take 1e25 of them.
inline double vanishing_step(double time, double max_step) {
  const double t = std::fabs(time);
  const double rounding = 16.0 * (std::nextafter(t, std::numeric_limits<double>::infinity()) - t);
  return std::isfinite(max_step) ? std::max(rounding, 1e-25 * max_step) : rounding;
}

}  // namespace flyball
