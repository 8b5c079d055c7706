#include "solvers/dormand_prince.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "blocks/jet.h"
#include "solvers/dormand_prince_tableau.h"
#include "solvers/step_failure.h"

namespace flyball {

using namespace dormand_prince;

namespace {

/// The sum of weights[j] * rates[j * stride], written out at compile time.
template <class T, std::size_t... J>
T combine(const double* weights, const T* rates, int stride, std::index_sequence<J...>) {
  return (... + (weights[J] * rates[static_cast<int>(J) * stride]));
}

template <class T>
constexpr int directions = 0;
template <>
constexpr int directions<Jet> = Jet::DIMENSION;

/// Part 0 is the value, part k the derivative along direction k - 1.
double part(double x, int) { return x; }
double part(const Jet& x, int p) { return p == 0 ? x.a : x.v[p - 1]; }

double weight(const StepperOptions& options, double before, double after) {
  return options.atol + options.rtol * std::max(std::fabs(before), std::fabs(after));
}

}  // namespace

template <class T>
DormandPrince<T>::DormandPrince(System<T>& system, const StepperOptions& options)
    : system_(system),
      options_(options),
      size_(system.size()),
      storage_(static_cast<std::size_t>(rows * size_), T(0.0)),
      begin_(std::numeric_limits<double>::quiet_NaN()),
      end_(begin_),
      taken_(0.0) {
  if (!(options.max_step > 0.0)) throw std::invalid_argument("dp5 needs a max_step above 0");
}

template <class T>
void DormandPrince<T>::restart(T t, const T* x, StepMemory&, bool changed) {
  const bool rates_hold = !changed && value_of(t) == value_of(end_);
  end_ = t;
  if (rates_hold) return;
  std::copy(x, x + size_, row(after));
  system_.rates(t, row(after), row(last_rate));
  ++this->statistics_.rate_evaluations;
  ++this->statistics_.restarts;
}

template <class T>
T DormandPrince<T>::step(T limit, StepMemory& memory) {
  if (value_of(limit) < value_of(end_)) throw std::logic_error("a step to a limit in the past");
  continue_from_end();
  if (size_ == 0) return idle_step(limit);
  const double remaining = value_of(limit) - value_of(begin_);
  if (!(memory.size > 0.0)) memory.size = first_step(remaining);
  bool rejected = false;
  for (;;) {
    const Reach next = reach(std::min(memory.size, options_.max_step), remaining, options_.max_step);
    attempt(next.lands ? limit : begin_ + next.size);
    const double error = error_norm();
    const double least = vanishing_step(value_of(begin_), options_.max_step);
    if (error <= 1.0 && (next.shortened || next.size >= least)) {
      remember(error, next, rejected, memory);
      ++this->statistics_.steps;
      return end_;
    }
    ++this->statistics_.rejected;
    rejected = true;
    memory.size = next.size / std::min(1.0 / least_factor, std::pow(error, exponent) / safety);
    if (!(memory.size >= least)) fail(memory.size);
  }
}

/// A diagram without states still has outputs: the rates are called for them.
template <class T>
T DormandPrince<T>::idle_step(T limit) {
  const double remaining = value_of(limit) - value_of(begin_);
  const Reach next = reach(options_.max_step, remaining, options_.max_step);
  end_ = next.lands ? limit : begin_ + next.size;
  system_.rates(end_, row(after), row(last_rate));
  ++this->statistics_.rate_evaluations;
  ++this->statistics_.steps;
  return end_;
}

template <class T>
void DormandPrince<T>::continue_from_end() {
  begin_ = end_;
  extended_ = false;
  std::copy(row(after), row(after) + size_, row(before));
  std::copy(row(last_rate), row(last_rate) + size_, row(0));
}

template <class T>
double DormandPrince<T>::first_step(double remaining) {
  const T* x = row(before);
  const T* rate = row(0);
  const auto norm = [&](auto&& component) {
    double sum = 0.0;
    for (int i = 0; i < size_; ++i) {
      const double weighted = component(i) / (options_.atol + options_.rtol * std::fabs(value_of(x[i])));
      sum += weighted * weighted;
    }
    return std::sqrt(sum / size_);
  };
  const double d0 = norm([&](int i) { return value_of(x[i]); });
  const double d1 = norm([&](int i) { return value_of(rate[i]); });
  const double guess = d0 < 1e-5 || d1 < 1e-5 ? 1e-6 : 0.01 * d0 / d1;
  const double least = vanishing_step(value_of(begin_), options_.max_step);
  const double h0 = std::max(std::min({guess, remaining, options_.max_step}), least);

  T* euler = row(trial);
  T* euler_rate = row(1);
  for (int i = 0; i < size_; ++i) euler[i] = x[i] + h0 * rate[i];
  system_.rates(begin_ + h0, euler, euler_rate);
  ++this->statistics_.rate_evaluations;
  const double d2 = norm([&](int i) { return value_of(euler_rate[i]) - value_of(rate[i]); }) / h0;
  const double curved = std::max(d1, d2);
  const double h1 = curved <= 1e-15 ? std::max(1e-6, 1e-3 * h0) : std::pow(0.01 / curved, 0.2);
  return std::max(std::min({100.0 * h0, h1, options_.max_step}), least);
}

template <class T>
void DormandPrince<T>::attempt(T end) {
  end_ = end;
  taken_ = end_ - begin_;
  stage(a2, begin_ + c2 * taken_, trial);
  stage(a3, begin_ + c3 * taken_, trial);
  stage(a4, begin_ + c4 * taken_, trial);
  stage(a5, begin_ + c5 * taken_, trial);
  stage(a6, end_, trial);
  stage(a7, end_, after);
  this->statistics_.rate_evaluations += stages - 1;
}

template <class T>
template <std::size_t N>
void DormandPrince<T>::stage(const double (&a)[N], T t, int target) {
  const T* x = row(before);
  const T* rates = row(0);
  T* y = row(target);
  for (int i = 0; i < size_; ++i) {
    y[i] = x[i] + taken_ * combine(a, rates + i, size_, std::make_index_sequence<N>());
  }
  system_.rates(t, y, row(static_cast<int>(N)));
}

template <class T>
T DormandPrince<T>::error_of(int i) const {
  return taken_ * combine(e, row(0) + i, size_, std::make_index_sequence<stages>());
}

template <class T>
double DormandPrince<T>::weighted_error(int i) const {
  return value_of(error_of(i)) / weight(options_, value_of(row(before)[i]), value_of(row(after)[i]));
}

template <class T>
double DormandPrince<T>::error_norm() const {
  constexpr int most_parts = 1 + directions<T>;
  const int parts = options_.derivative_errors ? most_parts : 1;
  double sums[most_parts] = {};
  for (int i = 0; i < size_; ++i) {
    const T error = error_of(i), &x0 = row(before)[i], &x1 = row(after)[i];
    for (int p = 0; p < parts; ++p) {
      const double weighted = part(error, p) / weight(options_, part(x0, p), part(x1, p));
      sums[p] += weighted * weighted;
    }
  }
  const double worst = *std::max_element(sums, sums + parts);
  return std::sqrt(worst / size_);
}

template <class T>
int DormandPrince<T>::limiting_state() const {
  int worst = -1;
  for (int i = 0; i < size_; ++i) {
    if (worst < 0 || std::fabs(weighted_error(i)) > std::fabs(weighted_error(worst))) worst = i;
  }
  return worst;
}

template <class T>
double DormandPrince<T>::step_times_stiffness() const {
  // The last two stages are at the same time, so that their rates differ by the Jacobian alone.
  const T *sixth = row(trial), *sixth_rate = row(last_rate - 1);
  double states = 0.0, rates = 0.0;
  for (int i = 0; i < size_; ++i) {
    const double scale = weight(options_, value_of(row(before)[i]), value_of(row(after)[i]));
    const double state = value_of(row(after)[i] - sixth[i]) / scale;
    const double rate = value_of(row(last_rate)[i] - sixth_rate[i]) / scale;
    states += state * state;
    rates += rate * rate;
  }
  return states > 0.0 ? value_of(taken_) * std::sqrt(rates / states) : 0.0;
}

template <class T>
void DormandPrince<T>::remember(double error, const Reach& taken, bool rejected, StepMemory& memory) const {
  // What is below this grows by the greatest factor; a power is as long as a whole stage of a small system.
  constexpr double negligible = 1e-9;
  const double shrink =
      error < negligible ? 0.0 : std::pow(error, exponent) / std::pow(memory.last_error, beta) / safety;
  double next = taken.size / std::clamp(shrink, 1.0 / greatest_factor, 1.0 / least_factor);
  if (rejected) next = std::min(next, taken.size);
  // The error of a shortened step belongs to a size that will not be tried again.
  if (taken.shortened && next < memory.size) return;
  memory.size = std::min(next, options_.max_step);
  memory.last_error = std::max(error, least_error);
}

template <class T>
void DormandPrince<T>::fail(double next) const {
  std::vector<double> weighted;
  for (int i = 0; i < size_; ++i) weighted.push_back(weighted_error(i));
  throw step_vanished(value_of(begin_), next, worst_states(system_, weighted));
}

/// A step may be asked for many points, so the sums over stages are made once.
template <class T>
void DormandPrince<T>::extend() {
  fill_hermite(taken_, row(0), row(last_rate), row(before), size_);
  T* bubble = row(before + Extension<T>::bubble);
  for (int i = 0; i < size_; ++i) {
    bubble[i] = taken_ * combine(d, row(0) + i, size_, std::make_index_sequence<stages>());
  }
  extended_ = true;
}

template <class T>
std::optional<Extension<T>> DormandPrince<T>::extension() {
  if (!extended_) extend();
  return Extension<T>{begin_, taken_, row(before), size_};
}

template class DormandPrince<double>;
template class DormandPrince<Jet>;

}  // namespace flyball
