#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace flyball {

/// The ends between which z changes side, and the end that was replaced last. Values are side * z.
struct RootBracket {
  double near, near_value;    // before the change: not below 0
  double far, far_value;      // behind it: below 0
  double third, third_value;  // as long as it equals `near`, there is none

  double width() const { return far - near; }
  double middle() const { return near + 0.5 * width(); }
  double secant() const { return near + width() * (near_value / (near_value - far_value)); }

  void replace(double t, double value) {
    const bool beyond = value < 0.0;
    third = beyond ? far : near;
    third_value = beyond ? far_value : near_value;
    (beyond ? far : near) = t;
    (beyond ? far_value : near_value) = value;
  }

  /// The inverse quadratic through the three points, where it has no turning point between them; else the
  /// middle.
  double quadratic() const {
    const bool near_moved = third < near;
    const double moved = near_moved ? near : far, other = near_moved ? far : near;
    const double moved_value = near_moved ? near_value : far_value;
    const double other_value = near_moved ? far_value : near_value;
    const double xi = (moved - other) / (third - other);
    const double phi = (moved_value - other_value) / (third_value - other_value);
    if (!(phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi)) return middle();
    const double from_other =
        moved_value * third_value / ((other_value - moved_value) * (other_value - third_value));
    const double from_third =
        other_value * moved_value / ((third_value - other_value) * (third_value - moved_value));
    return moved + (other - moved) * from_other + (third - moved) * from_third;
  }
};

/// The first side change of z in (a, b], for a z that is beyond zero at b, seen from `side` (the sign of z at
/// a: 1 or -1). Returns a point strictly on the far side, at most a few units in the last place after the
/// change. Zero is not yet the far side. Where z(b) is not beyond zero after all, by rounding, it is b.
///
/// z(a) itself may be zero or rounding noise, as after an event: then a point that is truly on the near side
/// is looked for first, halving. Where there is none, the point found is within rounding of a.
///
/// Inverse quadratic interpolation and bisection as T. R. Chandrupatla chooses between them (Adv. Eng. Softw.
/// 28 (1997) 145-149), after one secant, and a bisection wherever three evaluations did not halve the
/// bracket: 7 evaluations for a smooth z, both ends included, and at most 3 a bit for any. No allocation.
template <class F>
double locate_root(double a, double b, int side, F&& z) {
  // Around 0 there is always a number nearer to it: halving must end all the same.
  const double tolerance =
      std::max(4.0 * std::numeric_limits<double>::epsilon() * std::max(std::fabs(a), std::fabs(b)),
               std::numeric_limits<double>::min());
  const auto value = [&](double t) { return side * z(t); };
  RootBracket bracket{a, value(a), b, value(b), a, 0.0};
  if (bracket.far_value >= 0.0) return b;
  while (bracket.near_value <= 0.0 && bracket.width() > tolerance) {
    bracket.replace(bracket.middle(), value(bracket.middle()));
  }
  bracket.third = bracket.near;
  double halved = bracket.width();
  for (int k = 1; bracket.width() > tolerance; ++k) {
    double t = bracket.third == bracket.near ? bracket.secant() : bracket.quadratic();
    if (k % 3 == 0) {
      if (bracket.width() > 0.5 * halved) t = bracket.middle();
      halved = bracket.width();
    }
    // Half a tolerance away from the ends: a close estimate is to be overtaken, so that the bracket closes.
    t = std::clamp(t, bracket.near + 0.5 * tolerance, bracket.far - 0.5 * tolerance);
    bracket.replace(t, value(t));
  }
  return bracket.far;
}

}  // namespace flyball
