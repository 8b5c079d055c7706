#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace flyball {

/// The first side change of z in (a, b], for a z that is beyond zero at b, seen from `side` (the sign of z at
/// a: 1 or -1). Returns a point strictly on the far side, at most a few units in the last place after the
/// root.
///
/// z(a) itself may be zero or rounding noise, as after an event: then a point that is truly on the near side
/// is looked for first, halving towards a. Where there is none, the change is at a, and the point found is
/// within rounding of a.
///
/// Regula falsi with the weights of Anderson and Björck (BIT 13, 1973), and a bisection wherever three
/// evaluations did not halve the bracket; 6 to 8 evaluations for a smooth z. No allocation.
template <class F>
double locate_root(double a, double b, int side, F&& z) {
  const double tolerance =
      4.0 * std::numeric_limits<double>::epsilon() * std::max(std::fabs(a), std::fabs(b));
  double fa = side * z(a), fb = side * z(b);  // near side positive, far side negative
  while (fa <= 0.0 && b - a > tolerance) {
    const double middle = a + 0.5 * (b - a);
    const double f = side * z(middle);
    if (f > 0.0) {
      a = middle;
      fa = f;
    } else if (f < 0.0) {
      b = middle;
      fb = f;
    } else {
      break;  // flat at zero: nothing to interpolate, nothing that changes side before b
    }
  }
  if (fa <= 0.0) return b;
  int last = 0;  // which end moved last
  double halved = b - a;
  for (int k = 1; b - a > tolerance; ++k) {
    double c = b - fb * (b - a) / (fb - fa);
    if (k % 3 == 0) {
      if (b - a > 0.5 * halved) c = a + 0.5 * (b - a);
      halved = b - a;
    }
    c = std::clamp(c, a + 0.5 * tolerance, b - 0.5 * tolerance);
    const double f = side * z(c);
    if (f < 0.0) {
      if (last == 1) fa *= 1.0 - f / fb > 0.0 ? 1.0 - f / fb : 0.5;
      b = c;
      fb = f;
      last = 1;
    } else {
      if (last == -1) fb *= f < fa ? 1.0 - f / fa : 0.5;
      a = c;
      fa = f;
      last = -1;
    }
  }
  return b;
}

}  // namespace flyball
