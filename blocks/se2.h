#pragma once

#include "blocks/handles.h"
#include "blocks/scalar.h"

namespace flyball {

// Motions and points of the plane, on any scalar. The frame of a body: x forward, y to the left; headings are
// counter-clockwise from +x.

/// A function of one number, from its value and its slope. For functions whose formula divides by zero, or
/// has a kink that nobody locates, like those of min and max.
template <class T>
T function_of(const T& x, double (*value)(double), double (*slope)(double)) {
  if constexpr (std::is_same_v<T, double>) {
    return value(x);
  } else if constexpr (requires { value_of(x); }) {
    return (x - value_of(x)) * slope(value_of(x)) + value(value_of(x));
  } else if constexpr (requires { x.lane(0); }) {
    T result;
    for (int k = 0; k < T::width * T::parts; ++k) result.set_lane(k, value(x.lane(k)));
    return result;
  } else {
    return wrap(x);  // some function of a number
  }
}

// Defined in se2.cpp, so that no translation unit for other instruction sets has a copy.
double sinc_value(double x);
double sinc_slope(double x);
double saturated_asin_value(double x);
double saturated_asin_slope(double x);

/// sin(x)/x, and 1 at 0.
template <class T>
T sinc(const T& x) {
  return function_of(x, sinc_value, sinc_slope);
}

/// The angle whose sine is x, and a right angle beyond 1 and -1.
template <class T>
T saturated_asin(const T& x) {
  return function_of(x, saturated_asin_value, saturated_asin_slope);
}

template <class T>
struct Point {
  T x, y;
};

/// Both at once: in lanes, too, one call of the library.
template <class T>
Point<T> cos_and_sin(const T& x) {
  if constexpr (requires { x.lane(0); }) {
    Point<T> result;
    for (int k = 0; k < T::width * T::parts; ++k) {
      const double angle = x.lane(k);
      result.x.set_lane(k, std::cos(angle));
      result.y.set_lane(k, std::sin(angle));
    }
    return result;
  } else {
    return {cos(x), sin(x)};
  }
}

/// The pose that stands in these ports or slots.
template <class H>
auto pose_in(auto& v, const Pose<H>& at) {
  return Pose<std::decay_t<decltype(v.time())>>{v[at.x], v[at.y], v[at.theta]};
}

template <class H>
auto point_in(auto& v, H x, H y) {
  return Point<std::decay_t<decltype(v.time())>>{v[x], v[y]};
}

/// How far a body has gone, in its own frame, and how far it has turned.
template <class T>
struct Increment {
  T forward, left, turn;
};

/// What is taken for the direction of an increment: that of the chord of an arc, whose length is shorter than
/// the arc's by sinc(turn/2); the mean heading; or the heading before.
enum class Integration { exact, midpoint, euler };

/// Where an increment takes a body. `exact` is so for velocities that are constant in the body's frame.
template <class T>
Pose<T> moved(const Pose<T>& start, const Increment<T>& by, Integration rule = Integration::exact) {
  const T direction = rule == Integration::euler ? start.theta : start.theta + by.turn / 2.0;
  const T share = rule == Integration::exact ? sinc(by.turn / 2.0) : T(1.0);
  const Point<T> unit = cos_and_sin(direction);
  const T c = share * unit.x, s = share * unit.y;
  return {start.x + (c * by.forward - s * by.left), start.y + (s * by.forward + c * by.left),
          start.theta + by.turn};
}

/// Where a body sees a point: how far ahead, how far to the left.
template <class T>
Point<T> seen_from(const Pose<T>& body, const Point<T>& point) {
  const T dx = point.x - body.x, dy = point.y - body.y;
  const auto [c, s] = cos_and_sin(body.theta);
  return {c * dx + s * dy, c * dy - s * dx};
}

template <class T>
T distance_between(const Point<T>& a, const Point<T>& b) {
  return hypot(b.x - a.x, b.y - a.y);
}

/// How far a point is to the right of the line from a to b. Not a number when these are one point.
template <class T>
T right_of_line(const Point<T>& p, const Point<T>& a, const Point<T>& b) {
  const T dx = b.x - a.x, dy = b.y - a.y;
  return (dy * (p.x - a.x) - dx * (p.y - a.y)) / hypot(dx, dy);
}

/// The distance of a point from the segment from a to b, which may be one point.
template <class T>
T distance_from_segment(const Point<T>& p, const Point<T>& a, const Point<T>& b) {
  const T dx = b.x - a.x, dy = b.y - a.y;
  const T along = dx * (p.x - a.x) + dy * (p.y - a.y);
  const T share = clamp(along / max(dx * dx + dy * dy, T(smallest)), T(0.0), T(1.0));
  const T ox = p.x - a.x - share * dx, oy = p.y - a.y - share * dy;
  // A distance of 0 has no derivative.
  return sqrt(ox * ox + oy * oy + T(smallest));
}

}  // namespace flyball
