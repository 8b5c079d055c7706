#pragma once

#include <utility>

#include "solvers/dormand_prince_tableau.h"
#include "solvers/lane_arithmetic.h"

namespace flyball {

// Everything here has the instruction set in its type, so that the linker cannot take it for another's.
template <Isa isa, std::size_t... J>
Lanes<isa> combine(const double* weights, const Lanes<isa>* rates, int stride, std::index_sequence<J...>) {
  return (... + (Lanes<isa>(weights[J]) * rates[static_cast<int>(J) * stride]));
}

template <Isa isa, std::size_t N>
void stage_of(const LaneStep<isa>& step, const double (&weights)[N], Lanes<isa>* state) {
  const Lanes<isa>*x = step.row(LaneStep<isa>::before), *rates = step.row(0);
  const Lanes<isa> size = step.size;
  for (int i = 0; i < step.n; ++i) {
    state[i] = x[i] + size * combine<isa>(weights, rates + i, step.n, std::make_index_sequence<N>());
  }
}

template <Isa isa>
void LaneArithmetic<isa>::stage(const LaneStep<isa>& step, int stage, T* state) {
  switch (stage) {
    case 1:
      return stage_of(step, dormand_prince::a2, state);
    case 2:
      return stage_of(step, dormand_prince::a3, state);
    case 3:
      return stage_of(step, dormand_prince::a4, state);
    case 4:
      return stage_of(step, dormand_prince::a5, state);
    case 5:
      return stage_of(step, dormand_prince::a6, state);
    default:
      return stage_of(step, dormand_prince::a7, state);
  }
}

template <Isa isa>
void LaneArithmetic<isa>::errors(const LaneStep<isa>& step, double rtol, double atol, double* error) {
  const T *x0 = step.row(LaneStep<isa>::before), *x1 = step.row(LaneStep<isa>::after), *rates = step.row(0);
  T sum = 0.0;
  for (int i = 0; i < step.n; ++i) {
    const T difference =
        combine<isa>(dormand_prince::e, rates + i, step.n, std::make_index_sequence<LaneStep<isa>::stages>());
    const T weighted = step.size * difference / (atol + rtol * max(abs(x0[i]), abs(x1[i])));
    sum += weighted * weighted;
  }
  const T norm = sqrt(sum / static_cast<double>(step.n));
  for (int k = 0; k < lane_count; ++k) error[k] = norm.lane(k);
}

template <Isa isa>
void LaneArithmetic<isa>::extend(const LaneStep<isa>& step) {
  using Step = LaneStep<isa>;
  const T *x0 = step.row(Step::before), *x1 = step.row(Step::after), *rates = step.row(0);
  T *first = step.row(Step::extension), *last = first + step.n, *bubble = last + step.n;
  const T size = step.size;
  for (int i = 0; i < step.n; ++i) {
    const T chord = x1[i] - x0[i];
    first[i] = size * rates[i] - chord;
    last[i] = chord - size * rates[(Step::stages - 1) * step.n + i] - first[i];
    bubble[i] =
        size * combine<isa>(dormand_prince::d, rates + i, step.n, std::make_index_sequence<Step::stages>());
  }
}

template <Isa isa>
void LaneArithmetic<isa>::interpolate(const LaneStep<isa>& step, double theta, T* state) {
  using Step = LaneStep<isa>;
  const T *x0 = step.row(Step::before), *x1 = step.row(Step::after), *terms = step.row(Step::extension);
  const T at = theta, rest = 1.0 - theta;
  const int n = step.n;
  for (int i = 0; i < n; ++i) {
    const T inner = terms[n + i] + rest * terms[2 * n + i];
    state[i] = rest * x0[i] + at * (x1[i] + rest * (terms[i] + at * inner));
  }
}

template <Isa isa>
LaneMask LaneArithmetic<isa>::finite(const T* x, int n) {
  T sum = 0.0;  // 0 times a finite number
  for (int i = 0; i < n; ++i) sum += 0.0 * x[i];
  return opposite(nonzero(sum)).lanes();
}

template <Isa isa>
LaneMask LaneArithmetic<isa>::ordered(const T* x, int n) {
  LaneBit<isa> bad(LaneMask{0});
  for (int i = 0; i < n; ++i) bad = either(bad, unordered(x[i]));
  return opposite(bad).lanes();
}

template <Isa isa>
void LaneArithmetic<isa>::signs(const T* values, const int* slots, int n, LaneSigns* signs) {
  const T zero = 0.0;
  for (int k = 0; k < n; ++k) {
    signs[k] = {greater(values[slots[k]], zero).lanes(), greater(zero, values[slots[k]]).lanes()};
  }
}

template <Isa isa>
LaneMask LaneArithmetic<isa>::equal(const T& a, const T& b) {
  return opposite(nonzero(a - b)).lanes();
}

template <Isa isa>
void LaneArithmetic<isa>::blend(LaneMask mask, const T& x, T& y) {
  y = select(LaneBit<isa>(mask), x, y);
}

}  // namespace flyball
