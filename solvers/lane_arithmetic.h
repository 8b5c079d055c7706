#pragma once

#include "blocks/lanes.h"

namespace flyball {

/// Bit k stands for lane k.
using LaneMask = unsigned char;
inline constexpr LaneMask all_lanes = (1u << lane_count) - 1;

/// In which lanes a number is above zero, and in which below.
struct LaneSigns {
  LaneMask above = 0;
  LaneMask below = 0;
};

/// A step of Dormand and Prince's method for n states in lanes: rows of n, in the order of DormandPrince.
template <Isa isa>
struct LaneStep {
  static constexpr int stages = 7, before = 7, after = 8, extension = 9, rows = 12;

  Lanes<isa>* storage = nullptr;
  int n = 0;
  double size = 0.0;  // [s]

  Lanes<isa>* row(int r) const { return storage + r * n; }
};

/// The loops in which runs on lanes spend their time. Each instruction set has a translation unit of its own,
/// whose code must not run on a machine without it.
template <Isa isa>
struct LaneArithmetic {
  using T = Lanes<isa>;

  /// The state of a stage (1 … 6) from the rates of those before it.
  static void stage(const LaneStep<isa>& step, int stage, T* state);
  /// The weighted error of the step in each lane: DormandPrince tells the norm.
  static void errors(const LaneStep<isa>& step, double rtol, double atol, double* error);
  /// Prepares the continuous extension, and evaluates it at the fraction `theta` of the step.
  static void extend(const LaneStep<isa>& step);
  static void interpolate(const LaneStep<isa>& step, double theta, T* state);

  /// The lanes in which all of n numbers are finite.
  static LaneMask finite(const T* x, int n);
  /// The lanes in which none of n numbers is NaN.
  static LaneMask ordered(const T* x, int n);
  static void signs(const T* values, const int* slots, int n, LaneSigns* signs);
  /// The lanes in which a equals b.
  static LaneMask equal(const T& a, const T& b);
  /// Takes x in the lanes of the mask and leaves y in the others.
  static void blend(LaneMask mask, const T& x, T& y);
};

extern template struct LaneArithmetic<Isa::baseline>;
extern template struct LaneArithmetic<Isa::avx2>;

}  // namespace flyball
