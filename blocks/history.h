#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "blocks/scalar.h"

namespace flyball {

/// The past of a signal: what it was at five evenly spaced times of each step, as `on_step` tells it. Between
/// them it is the polynomial of fourth degree through the five, so what is recalled is as good as the
/// continuous extension of the fifth-order method. A segment begins where the signal begins or jumps, and has
/// a number, from 1 on; there is none before the start. What no one can ask for any more is forgotten.
class History {
 public:
  /// The signal at t, which never decreases. A second value at one time is a jump.
  void add(double t, double u, double forget_before);

  /// The signal in this segment at this time; beyond its ends, which rounding may ask for, its first or last
  /// polynomial. 0 where nothing is remembered. `now` gives its dimension, nothing else.
  template <class T>
  T at(const T& time, const T& segment, const T& now) const {
    if constexpr (std::is_same_v<T, Dependency>) {
      return curved(time + segment);
    } else if constexpr (std::is_same_v<T, Dimensional>) {
      return now;
    } else {
      return empty() ? T(0.0) : value(piece(value_of(time), value_of(segment)), time);
    }
  }

  /// The segment to read at this time, not before `segment`: the last one that has begun a delay ago.
  template <class T>
  T segment_at(const T& time, const T& delay, const T& segment) const {
    if constexpr (requires { value_of(segment); }) {
      double number = value_of(segment);
      while (start(number + 1.0) + value_of(delay) <= value_of(time) + rounding * value_of(time)) ++number;
      return number == value_of(segment) ? segment : T(number);
    } else {
      return segment;
    }
  }
  /// When that segment ends a delay later; `never` as long as it goes on.
  template <class T>
  T end_of(const T& delay, const T& segment) const {
    if constexpr (requires { value_of(segment); }) {
      const double end = start(value_of(segment) + 1.0);
      return end == never ? T(never) : end + delay;
    } else {
      return delay;
    }
  }

 private:
  static constexpr int points = 5;
  /// Alarms within so many units of a tick are at the tick.
  static constexpr double rounding = 16 * 0x1p-52;

  struct Piece {
    double begin = 0.0, end = 0.0;
    double segment = 0.0;
    std::array<double, points> u{};
  };
  struct Start {
    double segment, time;
  };

  bool empty() const { return size_ == 0; }
  const Piece& operator[](std::size_t k) const { return ring_[(first_ + k) % ring_.size()]; }
  void push(const Piece& piece);
  const Piece& piece(double time, double segment) const;
  double start(double segment) const;

  /// Newton's divided differences on points at 0, 1, …, 4.
  template <class T>
  static T value(const Piece& piece, const T& time) {
    std::array<double, points> d = piece.u;
    for (int order = 1; order < points; ++order) {
      for (int k = points - 1; k >= order; --k) d[k] = (d[k] - d[k - 1]) / order;
    }
    const T s = (time - piece.begin) * ((points - 1) / (piece.end - piece.begin));
    T sum = T(d[points - 1]);
    for (int k = points - 2; k >= 0; --k) sum = d[k] + (s - static_cast<double>(k)) * sum;
    return sum;
  }

  std::vector<Piece> ring_;  // of `size_` pieces from `first_` on, oldest first
  std::size_t first_ = 0, size_ = 0;
  std::vector<Start> starts_;  // of segments, from the oldest that is remembered
  Piece open_;                 // of the present step
  int filled_ = 0;             // points in it
};

}  // namespace flyball
