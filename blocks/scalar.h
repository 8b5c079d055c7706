#pragma once

#include <ceres/jet.h>

#include <cmath>
#include <limits>
#include <type_traits>

#include "blocks/dependency.h"

namespace flyball {

/// A value with its derivatives along four directions (three parameters and time, or four Jacobian columns).
using Jet = ceres::Jet<double, 4>;

// Equations call these without a qualifier: double finds std's, Jet and Dependency their own.
using std::acos;
using std::asin;
using std::atan;
using std::atan2;
using std::cos;
using std::cosh;
using std::exp;
using std::floor;
using std::hypot;
using std::log;
using std::log10;
using std::pow;
using std::sin;
using std::sinh;
using std::sqrt;
using std::tan;
using std::tanh;

/// The time of an alarm that is not set.
inline constexpr double never = std::numeric_limits<double>::infinity();

/// Tells equal numbers from unequal ones in a relation, to which 0 means no change. Far below any difference
/// of numbers that are not themselves next to it.
inline constexpr double smallest = std::numeric_limits<double>::min();

/// The truth value of a branch: bool, or for a Dependency the set that the truth depends on.
template <class T>
using Bit = std::conditional_t<std::is_same_v<T, Dependency>, DependencyBit, bool>;

inline bool both(bool a, bool b) { return a && b; }
inline bool either(bool a, bool b) { return a || b; }
inline bool opposite(bool a) { return !a; }

inline double value_of(double x) { return x; }
inline double value_of(const Jet& x) { return x.a; }

/// `a` where the bit is on, else `b`. The only branch that an equation may take on a signal.
inline double select(bool on, double a, double b) { return on ? a : b; }
inline Jet select(bool on, const Jet& a, const Jet& b) { return on ? a : b; }
inline Jet select(bool on, const Jet& a, double b) { return on ? a : Jet(b); }
inline Jet select(bool on, double a, const Jet& b) { return on ? Jet(a) : b; }

// Kinks that nobody locates: fit for parameters and sampled signals. Continuous signals want a relation.
inline double abs(double x) { return std::fabs(x); }
inline double min(double a, double b) { return b < a ? b : a; }
inline double max(double a, double b) { return a < b ? b : a; }
inline Jet abs(const Jet& x) { return x.a < 0.0 ? -x : x; }
inline Jet min(const Jet& a, const Jet& b) { return b.a < a.a ? b : a; }
inline Jet max(const Jet& a, const Jet& b) { return a.a < b.a ? b : a; }

/// The lower limit wins when the limits are crossed.
template <class T>
T clamp(const T& x, const T& lower, const T& upper) {
  return max(lower, min(upper, x));
}

/// The angle in [-pi, pi] that differs from `a` by whole turns (IEEE remainder).
inline double wrap(double a) { return std::remainder(a, 2.0 * M_PI); }
inline Jet wrap(const Jet& a) { return a + (std::remainder(a.a, 2.0 * M_PI) - a.a); }

}  // namespace flyball
