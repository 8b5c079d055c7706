#include "solvers/lane_stepper.h"

#include <algorithm>
#include <cmath>

#include "solvers/dormand_prince_tableau.h"

namespace flyball {

using namespace dormand_prince;

template <Isa isa>
LaneStepper<isa>::LaneStepper(LaneGroup<isa>& group, const StepperOptions& options, bool drops_stiff)
    : group_(group),
      options_(options),
      storage_(static_cast<std::size_t>(Step::rows * group.plan.layout.states()), T(0.0)),
      step_{storage_.data(), group.plan.layout.states(), 0.0},
      drops_stiff_(drops_stiff) {}

template <Isa isa>
void LaneStepper<isa>::rates(double t, T* dx) {
  group_.place(t);
  group_.run(group_.rates, dx);
  ++statistics_.rate_evaluations;
}

template <Isa isa>
void LaneStepper<isa>::restart(bool fresh) {
  if (fresh) {
    memory_ = {};
    stiffness_ = {};
  }
  for (StiffnessCount& count : stiffness_) count.restart();
  end_ = group_.time();
  std::copy_n(group_.states(), step_.n, step_.row(Step::after));
  group_.run(group_.rates, step_.row(last_rate));
  ++statistics_.rate_evaluations;
  ++statistics_.restarts;
}

template <Isa isa>
double LaneStepper<isa>::step(double limit) {
  begin_ = end_;
  extended_ = false;
  std::copy_n(step_.row(Step::after), step_.n, step_.row(Step::before));
  std::copy_n(step_.row(last_rate), step_.n, step_.row(0));
  const double remaining = limit - begin_;
  if (step_.n == 0) return leap(remaining, limit);
  if (!(memory_.size > 0.0)) memory_.size = first_step(remaining);
  bool rejected = false;
  for (;;) {
    const Reach next = reach(std::min(memory_.size, options_.max_step), remaining, options_.max_step);
    attempt(next.lands ? limit : begin_ + next.size);
    const double error = worst_error();
    if (group_.active() == 0) return end_;
    const double least = vanishing_step(begin_, options_.max_step);
    if (error <= 1.0 && (next.shortened || next.size >= least)) {
      remember(error, next, rejected);
      ++statistics_.steps;
      if (drops_stiff_) drop_stiff();
      return end_;
    }
    ++statistics_.rejected;
    rejected = true;
    memory_.size = next.size / std::min(1.0 / least_factor, std::pow(error, exponent) / safety);
    if (memory_.size >= least) continue;
    drop_vanished();
    memory_.size = next.size;
    if (group_.active() == 0) return end_;
  }
}

/// As DiscreteStep.
template <Isa isa>
double LaneStepper<isa>::leap(double remaining, double limit) {
  const Reach next = reach(options_.max_step, remaining, options_.max_step);
  end_ = next.lands ? limit : begin_ + next.size;
  group_.place(end_);
  ++statistics_.steps;
  return end_;
}

template <Isa isa>
void LaneStepper<isa>::attempt(double end) {
  end_ = end;
  step_.size = end_ - begin_;
  const double ends[] = {c2, c3, c4, c5};
  for (int s = 1; s < last_rate; ++s) {
    LaneArithmetic<isa>::stage(step_, s, group_.states());
    rates(s <= 4 ? begin_ + ends[s - 1] * step_.size : end_, step_.row(s));
  }
  LaneArithmetic<isa>::stage(step_, last_rate, step_.row(Step::after));
  std::copy_n(step_.row(Step::after), step_.n, group_.states());
  rates(end_, step_.row(last_rate));
}

/// Of the runs that can go on.
template <Isa isa>
double LaneStepper<isa>::worst_error() {
  LaneArithmetic<isa>::errors(step_, options_.rtol, options_.atol, error_.data());
  double worst = 0.0;
  for (int k = 0; k < lane_count; ++k) {
    const auto lane = static_cast<LaneMask>(1u << k);
    if ((group_.active() & lane) == 0) continue;
    if (std::isfinite(error_[k])) {
      worst = std::max(worst, error_[k]);
    } else {
      group_.drop(lane);
    }
  }
  return worst;
}

template <Isa isa>
void LaneStepper<isa>::drop_vanished() {
  for (int k = 0; k < lane_count; ++k) {
    if (!(error_[k] <= 1.0)) group_.drop(static_cast<LaneMask>(1u << k));
  }
}

/// What AutoStep tests, in each run.
template <Isa isa>
void LaneStepper<isa>::drop_stiff() {
  LaneMask due = 0;
  for (int k = 0; k < lane_count; ++k) {
    if (stiffness_[k].due()) due |= static_cast<LaneMask>(1u << k);
  }
  if (due == 0) return;
  // The state of the sixth stage is gone; the extension is not made yet, so that its first row is free.
  LaneArithmetic<isa>::stage(step_, last_rate - 1, step_.row(Step::extension));
  for (int k = 0; k < lane_count; ++k) {
    const auto lane = static_cast<LaneMask>(1u << k);
    if ((due & lane) == 0) continue;
    const bool limited = memory_.size < options_.max_step && step_times_stiffness(k) > StiffnessCount::limit;
    if (stiffness_[k].add(limited)) group_.drop(lane);
  }
}

/// As DormandPrince.
template <Isa isa>
double LaneStepper<isa>::step_times_stiffness(int lane) const {
  const T *before = step_.row(Step::before), *after = step_.row(Step::after);
  const T *sixth = step_.row(Step::extension), *rate = step_.row(last_rate),
          *sixth_rate = step_.row(last_rate - 1);
  double states = 0.0, rates = 0.0;
  for (int i = 0; i < step_.n; ++i) {
    const double size = std::max(std::fabs(before[i].lane(lane)), std::fabs(after[i].lane(lane)));
    const double scale = options_.atol + options_.rtol * size;
    const double state_change = (after[i].lane(lane) - sixth[i].lane(lane)) / scale;
    const double rate_change = (rate[i].lane(lane) - sixth_rate[i].lane(lane)) / scale;
    states += state_change * state_change;
    rates += rate_change * rate_change;
  }
  return states > 0.0 ? step_.size * std::sqrt(rates / states) : 0.0;
}

template <Isa isa>
void LaneStepper<isa>::remember(double error, const Reach& taken, bool rejected) {
  constexpr double negligible = 1e-9;  // grows by the greatest factor, as DormandPrince
  const double shrink =
      error < negligible ? 0.0 : std::pow(error, exponent) / std::pow(memory_.last_error, beta) / safety;
  double next = taken.size / std::clamp(shrink, 1.0 / greatest_factor, 1.0 / least_factor);
  if (rejected) next = std::min(next, taken.size);
  // The error of a shortened step belongs to a size that will not be tried again.
  if (taken.shortened && next < memory_.size) return;
  memory_.size = std::min(next, options_.max_step);
  memory_.last_error = std::max(error, least_error);
}

template <Isa isa>
double LaneStepper<isa>::norm_of(int lane, auto&& component) const {
  const T* x = step_.row(Step::before);
  double sum = 0.0;
  for (int i = 0; i < step_.n; ++i) {
    const double weighted = component(i) / (options_.atol + options_.rtol * std::fabs(x[i].lane(lane)));
    sum += weighted * weighted;
  }
  return std::sqrt(sum / step_.n);
}

/// As DormandPrince: the smallest of what each run would begin with.
template <Isa isa>
double LaneStepper<isa>::first_step(double remaining) {
  double h0 = std::min(remaining, options_.max_step);
  for (int k = 0; k < lane_count; ++k) h0 = std::min(h0, guess_of(k));
  const double least = vanishing_step(begin_, options_.max_step);
  h0 = std::max(h0, least);
  T* euler = group_.states();
  const T *x = step_.row(Step::before), *rate = step_.row(0);
  for (int i = 0; i < step_.n; ++i) {
    for (int k = 0; k < lane_count; ++k) euler[i].set_lane(k, x[i].lane(k) + h0 * rate[i].lane(k));
  }
  rates(begin_ + h0, step_.row(1));
  double h = options_.max_step;
  for (int k = 0; k < lane_count; ++k) h = std::min(h, first_step_of(k, h0));
  return std::max(std::min(100.0 * h0, h), least);
}

template <Isa isa>
double LaneStepper<isa>::guess_of(int lane) const {
  const double d0 = norm_of(lane, [&](int i) { return step_.row(Step::before)[i].lane(lane); });
  const double d1 = norm_of(lane, [&](int i) { return step_.row(0)[i].lane(lane); });
  return d0 < 1e-5 || d1 < 1e-5 ? 1e-6 : 0.01 * d0 / d1;
}

template <Isa isa>
double LaneStepper<isa>::first_step_of(int lane, double h0) const {
  const T *rate = step_.row(0), *euler_rate = step_.row(1);
  const double d1 = norm_of(lane, [&](int i) { return rate[i].lane(lane); });
  const double d2 = norm_of(lane, [&](int i) { return euler_rate[i].lane(lane) - rate[i].lane(lane); }) / h0;
  const double curved = std::max(d1, d2);
  return curved <= 1e-15 ? std::max(1e-6, 1e-3 * h0) : std::pow(0.01 / curved, 0.2);
}

template <Isa isa>
void LaneStepper<isa>::interpolate(double t) {
  if (!extended_) LaneArithmetic<isa>::extend(step_);
  extended_ = true;
  group_.place(t);
  LaneArithmetic<isa>::interpolate(step_, (t - begin_) / step_.size, group_.states());
}

template class LaneStepper<Isa::baseline>;
template class LaneStepper<Isa::avx2>;

}  // namespace flyball
