#include "solvers/exact_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solvers/errors.h"
#include "solvers/reach.h"

namespace flyball {
namespace {

constexpr std::size_t lengths_kept = 8;

/// x = z + g + columns z, where g is the first column; with the number of states known to the compiler, they
/// stay in registers.
template <int states>
void move(const double* column, const double* z, int count, double* x, int n) {
  if constexpr (states > 0) {
    double sum[states];
    for (int i = 0; i < states; ++i) sum[i] = column[i];
    for (int j = 0; j < count; ++j) {
      column += states;
      for (int i = 0; i < states; ++i) sum[i] += column[i] * z[j];
    }
    for (int i = 0; i < states; ++i) x[i] = z[i] + sum[i];
  } else {
    for (int i = 0; i < n; ++i) {
      double sum = column[i];
      for (int j = 0; j < count; ++j) sum += column[(j + 1) * n + i] * z[j];
      x[i] = z[i] + sum;
    }
  }
}

template <int... states>
auto move_for(int n, std::integer_sequence<int, states...>) {
  constexpr decltype(&move<0>) moves[] = {move<states>...};
  return n < static_cast<int>(sizeof...(states)) ? moves[n] : move<0>;
}

}  // namespace

ExactStep::ExactStep(System<double>& system, const StepperOptions& options)
    : system_(system),
      options_(options),
      size_(system.size()),
      move_(move_for(size_, std::make_integer_sequence<int, 9>())),
      before_(size_),
      after_(size_),
      rate_(size_),
      known_(lengths_kept),
      propagator_(static_cast<std::size_t>(size_) * size_),
      term_(propagator_.size()),
      product_(propagator_.size()) {}

void ExactStep::restart(double t, const double* x, StepMemory&, bool) {
  end_ = t;
  linear_ = system_.linear_rates();
  if (linear_ != nullptr && linear_->version != version_) {
    version_ = linear_->version;
    forget();
  }
  std::copy_n(x, size_, after_.begin());
  if (linear_ != nullptr) system_.held_inputs(after_.data() + size_);
  ++statistics_.restarts;
}

/// What is known holds for other rates.
void ExactStep::forget() {
  const std::size_t all = size_ + linear_->inputs.size() / size_;
  before_.resize(all);
  after_.resize(all);
  inside_.columns.resize((all + 1) * size_);
  for (Leap& leap : known_) {
    leap.length = 0.0;
    leap.columns.resize(inside_.columns.size());
  }
}

double ExactStep::step(double limit, StepMemory&) {
  begin_ = end_;
  std::swap(before_, after_);
  const Reach next = reach(options_.max_step, limit - begin_, options_.max_step);
  end_ = next.lands ? limit : begin_ + next.size;
  ++statistics_.steps;
  if (size_ == 0) return end_;
  go(leap(end_ - begin_), after_.data());
  std::copy(before_.begin() + size_, before_.end(), after_.begin() + size_);
  require_finite();
  return end_;
}

/// A rate that is not finite has a name of its own.
void ExactStep::require_finite() {
  double zero = 0.0;  // 0 times a finite number
  for (int i = 0; i < size_; ++i) zero += 0.0 * after_[i];
  if (zero == 0.0) return;
  ++statistics_.rate_evaluations;
  system_.rates(begin_, before_.data(), rate_.data());
}

void ExactStep::interpolate(double t, double* x) {
  if (t == end_) {
    std::copy_n(after_.begin(), size_, x);
    return;
  }
  if (size_ == 0) return;
  propagate(t - begin_, linear().matrix, propagator_);
  write(inside_);
  go(inside_, x);
}

const LinearRates& ExactStep::linear() const {
  if (linear_ != nullptr) return *linear_;
  throw SimulationError(
      SimulationError::Kind::solver, begin_,
      "the method \"exact\" needs rates that are affine in a few states and do not depend on "
      "time during a step; \"dp5\" does without");
}

const ExactStep::Leap& ExactStep::leap(double length) {
  const LinearRates& rates = linear();
  // Ticks are rounded, so equal periods differ in the last places of time.
  const double same = 4.0 * std::numeric_limits<double>::epsilon() * std::fabs(end_);
  const auto fits = [&](const Leap& leap) {
    return std::fabs(leap.length - length) <= same && leap.length > 0.0;
  };
  if (fits(known_[latest_])) return known_[latest_];
  const auto found = std::ranges::find_if(known_, fits);
  latest_ = found - known_.begin();
  if (found != known_.end()) return *found;
  latest_ = oldest_;
  oldest_ = (oldest_ + 1) % known_.size();
  known_[latest_].length = length;
  propagate(length, rates.matrix, propagator_);
  write(known_[latest_]);
  return known_[latest_];
}

/// The columns of a step from its propagator.
void ExactStep::write(Leap& leap) const {
  const int inputs = static_cast<int>(before_.size()) - size_;
  const auto entry = [&](int k, int column) {  // of b, A and B next to each other
    if (column == 0) return linear_->offset[k];
    return column <= size_ ? linear_->matrix[k * size_ + column - 1]
                           : linear_->inputs[k * inputs + column - 1 - size_];
  };
  for (int column = 0; column <= size_ + inputs; ++column) {
    for (int i = 0; i < size_; ++i) {
      double sum = 0.0;
      for (int k = 0; k < size_; ++k) sum += propagator_[i * size_ + k] * entry(k, column);
      leap.columns[column * size_ + i] = sum;
    }
  }
}

/// Sums the series for a length at which it converges fast, then doubles: P(2h) = P(h) (2 + A P(h)).
void ExactStep::propagate(double length, const Matrix& a, Matrix& result) {
  double norm = 0.0;  // of rows
  for (int i = 0; i < size_; ++i) {
    double row = 0.0;
    for (int j = 0; j < size_; ++j) row += std::fabs(a[i * size_ + j]);
    norm = std::max(norm, row);
  }
  int doublings = 0;
  double h = length;
  for (; h * norm > 0.5; h *= 0.5) ++doublings;
  constexpr int terms = 14;  // 0.5^14 / 15! is below the rounding of the first term
  std::ranges::fill(term_, 0.0);
  for (int i = 0; i < size_; ++i) term_[i * size_ + i] = h;
  result = term_;
  for (int k = 2; k <= terms; ++k) {
    multiply(a, term_, product_);
    for (std::size_t e = 0; e < term_.size(); ++e) result[e] += term_[e] = product_[e] * h / k;
  }
  for (; doublings > 0; --doublings) {
    multiply(a, result, product_);
    for (int i = 0; i < size_; ++i) product_[i * size_ + i] += 2.0;
    multiply(result, product_, term_);
    std::swap(result, term_);
  }
}

void ExactStep::multiply(const Matrix& a, const Matrix& b, Matrix& result) const {
  std::ranges::fill(result, 0.0);
  for (int i = 0; i < size_; ++i) {
    for (int k = 0; k < size_; ++k) {
      for (int j = 0; j < size_; ++j) result[i * size_ + j] += a[i * size_ + k] * b[k * size_ + j];
    }
  }
}

}  // namespace flyball
