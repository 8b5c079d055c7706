#include "studies/fit/signal_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solvers/errors.h"
#include "solvers/simulator.h"

namespace flyball {
namespace {

/// Of all runs of a fit. Exact derivatives need it as much as differences do: at a looser tolerance a fit
/// takes more iterations than it saves steps.
constexpr double tolerance = 1e-10;

int column_of(const Plan& plan, const std::string& signal) {
  const auto found = std::ranges::find(plan.columns, signal, &LogColumn::name);
  return static_cast<int>(found - plan.columns.begin());
}

/// The settings of runs that end at the last time of the data, with steps as the model has them.
SimulationSettings settings_until(double end, SimulationSettings settings) {
  settings.max_step = settings.max_step.value_or(settings.stop / 50.0);
  settings.step = settings.step.value_or(settings.stop / 1000.0);
  settings.stop = end;
  return settings;
}

}  // namespace

SignalModel::SignalModel(SignalRequest request, const std::vector<Unknown>& unknowns)
    : request_(std::move(request)), unknowns_(unknowns) {
  for (const double t : request_.times) {
    if (times_.empty() || t > times_.back()) times_.push_back(t);
    row_.push_back(static_cast<int>(times_.size()) - 1);
  }
  for (const std::string& signal : request_.signals) columns_.push_back(column_of(*request_.plan, signal));
  for (const Unknown& unknown : unknowns_) slots_.push_back(settable_parameter(*request_.plan, unknown.name));
  request_.settings = settings_until(times_.back(), request_.settings);
  if (request_.exact) make_exact();
}

void SignalModel::make_exact() {
  SensitivityRequest wanted;
  for (const Unknown& unknown : unknowns_) wanted.parameters.push_back(unknown.name);
  wanted.signals = request_.signals;
  wanted.times = times_;
  wanted.set = request_.set;
  SensitivityOptions options;
  options.rtol = tolerance;
  try {
    exact_ = std::make_unique<Sensitivities>(request_.plan, request_.settings, std::move(wanted), options);
  } catch (const std::invalid_argument& refusal) {
    go_numeric(refusal.what());
  }
}

void SignalModel::go_numeric(const std::string& why) {
  exact_.reset();
  remark(fmt::format("{}; so the gradient is by central differences", why));
}

void SignalModel::remark(const std::string& text) {
  if (std::ranges::find(remarks_, text) == remarks_.end()) remarks_.push_back(text);
}

bool SignalModel::run(std::span<const double> parameters, bool derivatives) {
  const bool same = !values_.empty() && std::ranges::equal(parameters, parameters_);
  if (!same) {
    has_derivatives_ = false;
    values_.clear();
    parameters_.assign(parameters.begin(), parameters.end());
    const bool done = exact_ != nullptr ? run_exact(parameters) : run_plain(parameters, values_);
    if (!done) return false;
  }
  return !derivatives || has_derivatives_ || differentiate();
}

/// Where the derivatives of this point fail, the values of a plain run may still be there.
bool SignalModel::run_exact(std::span<const double> parameters) {
  try {
    ++simulations_;
    exact_->run(parameters);
  } catch (const std::invalid_argument& refusal) {
    failure_ = refusal.what();
    return false;
  } catch (const SimulationError& error) {
    if (!run_plain(parameters, values_)) return false;
    remark(fmt::format("{}; there the gradient is by central differences", error.what()));
    return true;
  }
  const auto width = static_cast<int>(columns_.size());
  spread(exact_->values(), width, values_);
  for (const SensitivityWarning& warning : exact_->warnings()) {
    if (warning.kind == SensitivityWarning::Kind::opaque) {
      go_numeric(warning.message);
      return true;
    }
    const bool grazes = warning.kind == SensitivityWarning::Kind::grazing;
    remark(grazes ? warning.message + "; there the gradient is by central differences" : warning.message);
  }
  spread(exact_->derivatives(), width * static_cast<int>(unknowns_.size()), derivatives_);
  has_derivatives_ = std::ranges::all_of(derivatives_, [](double d) { return std::isfinite(d); });
  return true;
}

bool SignalModel::run_plain(std::span<const double> parameters, std::vector<double>& values) {
  SimulationSettings settings = request_.settings;
  settings.atol *= std::min(tolerance / settings.rtol, 1.0);
  settings.rtol = std::min(settings.rtol, tolerance);
  ++simulations_;
  try {
    Simulator simulator(request_.plan, settings, {true, EventRows::none, times_});
    ParameterSet set = request_.set;
    for (std::size_t p = 0; p < parameters.size(); ++p) set.emplace_back(slots_[p], parameters[p]);
    simulator.set_parameters(set);
    simulator.run();
    const Log& log = simulator.log();
    if (log.rows() != static_cast<std::int64_t>(times_.size())) {
      failure_ = fmt::format("the run ended at t = {} s, before the data do ({})", simulator.time(),
                             simulator.end_reason());
      return false;
    }
    std::vector<double> rows;
    for (std::int64_t row = 0; row < log.rows(); ++row) {
      for (const int column : columns_) rows.push_back(log.value(row, column));
    }
    spread(rows, static_cast<int>(columns_.size()), values);
    return true;
  } catch (const std::invalid_argument& refusal) {
    failure_ = refusal.what();
  } catch (const SimulationError& error) {
    failure_ = error.what();
  }
  return false;
}

/// Rows of distinct times to rows of the times that were asked for.
void SignalModel::spread(const std::vector<double>& rows, int width, std::vector<double>& result) const {
  if (times_.size() == row_.size()) {
    result = rows;
    return;
  }
  result.clear();
  for (const int row : row_)
    result.insert(result.end(), rows.begin() + row * width, rows.begin() + (row + 1) * width);
}

bool SignalModel::differentiate() {
  derivatives_.assign(values_.size() * unknowns_.size(), 0.0);
  for (std::size_t p = 0; p < unknowns_.size(); ++p) {
    if (!difference(p, parameters_)) {
      failure_ = fmt::format("there is no derivative by {}: {}", unknowns_[p].name, failure_);
      return false;
    }
  }
  has_derivatives_ = true;
  return true;
}

/// Central; one-sided at a bound and where one side cannot be simulated.
bool SignalModel::difference(std::size_t p, const std::vector<double>& at) {
  const Unknown& unknown = unknowns_[p];
  const double h = unknown.difference_step(at[p]);
  std::vector<double> left = values_, right = values_, moved = at;
  moved[p] = at[p] + h;
  const bool has_right = moved[p] <= unknown.upper && run_plain(moved, right);
  moved[p] = at[p] - h;
  const bool has_left = moved[p] >= unknown.lower && run_plain(moved, left);
  if (!has_left && !has_right) return false;
  if (!has_right) right = values_;
  if (!has_left) left = values_;
  const double width = (has_left && has_right ? 2.0 : 1.0) * h;
  for (std::size_t i = 0; i < values_.size(); ++i)
    derivatives_[i * unknowns_.size() + p] = (right[i] - left[i]) / width;
  return true;
}

}  // namespace flyball
