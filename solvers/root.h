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

/// Where the parabola with these values and this slope leaves the positive side; NaN where it does not.
inline double parabola_root(double a, double at_a, double slope_at_a, double b, double at_b) {
  const double c1 = slope_at_a * (b - a), c2 = at_b - at_a - c1;
  const double root = std::sqrt(c1 * c1 - 4.0 * at_a * c2);
  return a + (b - a) * (c1 < 0.0 ? 2.0 * at_a / (root - c1) : (root + c1) / (-2.0 * c2));
}

/// The same for a z whose derivative is known: Newton's method, from the root of a parabola, leaves a bracket
/// of a few roundings.
template <class F, class D>
double locate_root(double a, double b, int side, F&& z, D&& slope) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  constexpr int enough = 30;  // steps; where they do not suffice, the bracket is large and nothing is lost
  const double tolerance = 4.0 * epsilon * std::max(std::fabs(a), std::fabs(b));
  const double at_b = z(b), rounding = 4.0 * epsilon * std::fabs(at_b);
  const auto inside = [&](double t, double near, double far) { return t > near && t < far; };
  double near = a, far = b, blur = tolerance;
  double t = parabola_root(a, side * z(a), side * slope(a), b, side * at_b);
  if (!inside(t, near, far)) t = near + 0.5 * (far - near);
  for (int k = 0; k < enough; ++k) {
    const double value = z(t), steepness = slope(t);
    (side * value < 0.0 ? far : near) = t;
    // The root is no sharper than the rounding of z, whose terms are as large as z(b).
    blur = std::max(tolerance, rounding / std::fabs(steepness));
    const double change = value / steepness;
    if (std::fabs(change) <= blur) break;
    t = inside(t - change, near, far) ? t - change : near + 0.5 * (far - near);
  }
  const double before = t - blur, after = t + blur;
  if (inside(after, near, far) && side * z(after) < 0.0) far = after;
  if (inside(before, near, far) && side * z(before) > 0.0) near = before;
  return locate_root(near, far, side, z);
}

}  // namespace flyball
