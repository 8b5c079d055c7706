#include "solvers/exact_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solvers/errors.h"
#include "solvers/reach.h"

namespace flyball {
namespace {

constexpr std::size_t lengths_kept = 8;

}  // namespace

ExactStep::ExactStep(System<double>& system, const StepperOptions& options)
    : system_(system),
      options_(options),
      size_(system.size()),
      before_(size_),
      after_(size_),
      rate_before_(size_),
      rate_after_(size_),
      known_(lengths_kept),
      term_(static_cast<std::size_t>(size_) * size_),
      product_(term_.size()),
      inside_(term_.size()) {
  for (Propagator& p : known_) p.of = p.value = Matrix(term_.size());
}

void ExactStep::restart(double t, const double* x, StepMemory&, bool) {
  // Also where nothing changed: only a call of the rates tells the linear part after an instant.
  end_ = t;
  std::copy_n(x, size_, after_.begin());
  system_.rates(t, after_.data(), rate_after_.data());
  rate_after_known_ = true;
  ++statistics_.rate_evaluations;
  ++statistics_.restarts;
}

double ExactStep::step(double limit, StepMemory&) {
  begin_ = end_;
  std::swap(before_, after_);
  std::swap(rate_before_, rate_after_);
  if (!rate_after_known_) {
    system_.rates(begin_, before_.data(), rate_before_.data());
    ++statistics_.rate_evaluations;
  }
  rate_after_known_ = false;
  const Reach next = reach(options_.max_step, limit - begin_, options_.max_step);
  end_ = next.lands ? limit : begin_ + next.size;
  std::copy(before_.begin(), before_.end(), after_.begin());
  if (size_ > 0) advance(propagator(end_ - begin_), after_.data());
  ++statistics_.steps;
  return end_;
}

void ExactStep::interpolate(double t, double* x) {
  if (t == end_) {
    std::copy(after_.begin(), after_.end(), x);
    return;
  }
  std::copy(before_.begin(), before_.end(), x);
  if (size_ == 0) return;
  propagate(t - begin_, linear_part(), inside_);
  advance(inside_, x);
}

const ExactStep::Matrix& ExactStep::linear_part() const {
  const Matrix* a = system_.linear_part();
  if (a != nullptr) return *a;
  throw SimulationError(
      SimulationError::Kind::solver, begin_,
      "the method \"exact\" needs rates that are affine in a few states and do not depend on "
      "time during a step; \"dp5\" does without");
}

const ExactStep::Matrix& ExactStep::propagator(double length) {
  const Matrix& a = linear_part();
  // Ticks are rounded, so equal periods differ in the last places of time.
  const double same = 4.0 * std::numeric_limits<double>::epsilon() * std::fabs(end_);
  for (const Propagator& p : known_) {
    if (std::fabs(p.length - length) <= same && p.length > 0.0 && p.of == a) return p.value;
  }
  Propagator& replaced = known_[oldest_];
  oldest_ = (oldest_ + 1) % known_.size();
  replaced.length = length;
  replaced.of = a;
  propagate(length, a, replaced.value);
  return replaced.value;
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

void ExactStep::advance(const Matrix& propagator, double* x) const {
  const double* row = propagator.data();
  for (int i = 0; i < size_; ++i, row += size_) {
    for (int j = 0; j < size_; ++j) x[i] += row[j] * rate_before_[j];
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
