#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <type_traits>

#include "blocks/dependency.h"
#include "blocks/dimensional.h"

namespace ceres {
template <class T, int N>
struct Jet;
}

namespace flyball {

/// A value with its derivatives along four directions (three parameters and time, or four Jacobian columns).
/// Whoever computes with it includes blocks/jet.h, and Eigen with it; all others name it only.
using Jet = ceres::Jet<double, 4>;

// Equations call these without a qualifier: double finds std's, Jet, Dependency and Dimensional their own.
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

/// The truth value of a branch: bool, for a Dependency the set that the truth depends on, for lanes one each.
template <class T>
struct BitOf {
  using type = bool;
};
template <>
struct BitOf<Dependency> {
  using type = DependencyBit;
};
template <class T>
using Bit = typename BitOf<T>::type;

inline bool both(bool a, bool b) { return a && b; }
inline bool either(bool a, bool b) { return a || b; }
inline bool opposite(bool a) { return !a; }

inline double value_of(double x) { return x; }
inline double value_of(const Jet& x);

inline bool nonzero(double x) { return x != 0.0; }
inline bool nonzero(const Jet& x);

/// Entry number `count`, from 0 to size - 1, of a table, for handlers: a held value counts. Each lane looks
/// up its own; scalars without a value take the first entry, which stands for all.
template <class T>
T look_up(const T& count, int size, auto&& entry) {
  // Not std::lround, which costs a call.
  const auto index = [&](double x) { return x > 0.0 ? static_cast<int>(std::min(x, size - 1.0) + 0.5) : 0; };
  if constexpr (requires { value_of(count); }) {
    return entry(index(value_of(count)));
  } else if constexpr (requires { count.lane(0); }) {
    T result;
    for (int k = 0; k < T::width * T::parts; ++k) result.set_lane(k, entry(index(count.lane(k))).lane(k));
    return result;
  } else {
    return entry(0);
  }
}

/// A function of numbers that is constant between jumps which nobody locates: fit for sampled signals. Each
/// lane has a value of its own; a derivative is 0.
template <class T>
T stepwise(auto&& function, const T& first, const std::same_as<T> auto&... others) {
  if constexpr (requires { value_of(first); }) {
    return T(function(value_of(first), value_of(others)...));
  } else if constexpr (requires { first.lane(0); }) {
    T result;
    for (int k = 0; k < T::width * T::parts; ++k)
      result.set_lane(k, function(first.lane(k), others.lane(k)...));
    return result;
  } else if constexpr (std::is_same_v<T, Dependency>) {
    return curved((first + ... + others));
  } else {
    return T(1.0);
  }
}

/// `a` where the bit is on, else `b`. The only branch that an equation may take on a signal.
inline double select(bool on, double a, double b) { return on ? a : b; }
inline Jet select(bool on, const Jet& a, const Jet& b);
inline Jet select(bool on, const Jet& a, double b);
inline Jet select(bool on, double a, const Jet& b);

// Kinks that nobody locates: fit for parameters and sampled signals. Continuous signals want a relation.
inline double abs(double x) { return std::fabs(x); }
inline double min(double a, double b) { return b < a ? b : a; }
inline double max(double a, double b) { return a < b ? b : a; }
inline Jet abs(const Jet& x);
inline Jet min(const Jet& a, const Jet& b);
inline Jet max(const Jet& a, const Jet& b);

/// The lower limit wins when the limits are crossed.
template <class T>
T clamp(const T& x, const T& lower, const T& upper) {
  return max(lower, min(upper, x));
}

/// The angle in [-pi, pi] that differs from `a` by whole turns (IEEE remainder).
inline double wrap(double a) { return std::remainder(a, 2.0 * M_PI); }
inline Jet wrap(const Jet& a);

}  // namespace flyball
