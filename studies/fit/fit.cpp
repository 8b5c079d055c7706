#include "studies/fit/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "blocks/random.h"
#include "studies/engine/run_setup.h"
#include "studies/fit/identification.h"
#include "studies/fit/least_squares.h"
#include "studies/fit/objective.h"
#include "studies/language/study_messages.h"

namespace flyball {
namespace {

/// A bound that is nearer than this part of the scale was met.
constexpr double at_bound = 1e-7;

/// "study.toml:12:1: error: fit.gains: ", or "error: " for a fit that no file holds.
std::string prefix_of(const Study& study, const FitDefinition& fit) {
  if (fit.at.line == 0) return "error: ";
  return fmt::format("{}:{}:{}: error: fit.{}: ", study.file, fit.at.line, fit.at.column, fit.name);
}

/// One run of [fit.NAME] from the definition to the result.
class Fit {
 public:
  Fit(const Study& study, const FitDefinition& fit, Evaluator& evaluator, int threads,
      const std::function<bool(int, double)>& progress);
  FitResult run();

 private:
  std::vector<Setting> settings_of(const FitExperiment& experiment) const;
  void check_matches(const FitExperiment& experiment, const Plan& plan) const;
  ComparedRun compared_run(const FitExperiment& experiment);
  std::optional<Judgement> judgement();
  Objective objective();
  std::vector<double> starting_point(int start) const;
  LeastSquaresSolution solve(int start);
  void search();
  void fill_parameters();
  void keep_curves(std::vector<double> FittedSignal::*curve);
  void identify_parameters();
  template <class F>
  auto told(F&& f) const;

  const Study& study_;
  const FitDefinition& fit_;
  Evaluator& evaluator_;
  int threads_;
  const std::function<bool(int, double)>& progress_;
  std::string prefix_;
  std::vector<Unknown> unknowns_;
  Objective objective_;
  LeastSquaresSolution best_;
  FitResult result_;
};

/// Calls `f` and puts where the fit stands before what is wrong.
template <class F>
auto Fit::told(F&& f) const {
  try {
    return f();
  } catch (const FitError&) {
    throw;
  } catch (const std::invalid_argument& error) {
    throw FitError(prefix_ + error.what());
  }
}

Fit::Fit(const Study& study, const FitDefinition& fit, Evaluator& evaluator, int threads,
         const std::function<bool(int, double)>& progress)
    : study_(study),
      fit_(fit),
      evaluator_(evaluator),
      threads_(threads),
      progress_(progress),
      prefix_(prefix_of(study, fit)),
      unknowns_(unknowns_of(fit.parameters, *study.models[fit.model].plan, prefix_)),
      objective_(objective()) {
  result_.name = fit.name;
}

/// Those for the model of the fit.
std::vector<Setting> Fit::settings_of(const FitExperiment& experiment) const {
  std::vector<Setting> settings = experiment.settings;
  std::erase_if(settings, [&](const Setting& s) { return s.model >= 0 && s.model != fit_.model; });
  return settings;
}

void Fit::check_matches(const FitExperiment& experiment, const Plan& plan) const {
  std::vector<std::string> logged;
  for (const LogColumn& column : plan.columns) logged.push_back(column.name);
  for (const FitExperiment::Match& match : experiment.matches) {
    if (std::ranges::find(logged, match.signal) == logged.end())
      throw FitError(prefix_ + message::no_such_thing("logged signal", match.signal, logged));
  }
  for (const Setting& setting : experiment.settings) {
    if (std::ranges::find(unknowns_, setting.name, &Unknown::name) != unknowns_.end())
      throw FitError(fmt::format("{}{} is sought, and set by the experiment {}", prefix_, setting.name,
                                 experiment.name));
  }
  if (experiment.matches.empty())
    throw FitError(fmt::format("{}{} is matched with no signal", prefix_, experiment.data));
}

ComparedRun Fit::compared_run(const FitExperiment& experiment) {
  SignalRequest request;
  // The run's own settings, methods and sample times take another plan, if need be.
  RunSetup setup = told([&] { return Setups(study_.models).make(fit_.model, settings_of(experiment)); });
  request.plan = std::move(setup.plan);
  request.settings = std::move(setup.settings);
  request.set = std::move(setup.parameters);
  check_matches(experiment, *request.plan);
  Measurements measured = read_measurements(experiment, request.plan->columns);
  std::vector<double> weights;
  for (const FitExperiment::Match& match : experiment.matches) {
    request.signals.push_back(match.signal);
    weights.push_back(match.weight);
  }
  request.times = measured.times;
  request.exact = fit_.gradient == "exact";
  return {std::move(measured), std::move(weights), SignalModel(std::move(request), unknowns_)};
}

/// Each experiment is judged; without one, the model as it is.
std::optional<Judgement> Fit::judgement() {
  if (fit_.requirements.empty() && fit_.minimise.empty()) return std::nullopt;
  std::vector<std::vector<Setting>> runs;
  for (const FitExperiment& experiment : fit_.experiments) runs.push_back(settings_of(experiment));
  if (runs.empty()) runs.emplace_back();
  return Judgement(study_, fit_, unknowns_, std::move(runs), evaluator_, threads_);
}

Objective Fit::objective() {
  std::vector<ComparedRun> runs;
  for (const FitExperiment& experiment : fit_.experiments) {
    if (!experiment.data.empty()) runs.push_back(compared_run(experiment));
  }
  std::optional<Judgement> judged = judgement();
  if (runs.empty() && !judged) throw FitError(prefix_ + "there is nothing to compare the model with");
  const Loss loss = told([&] { return Loss(fit_.loss, fit_.loss_scale); });
  return Objective(unknowns_, std::move(runs), std::move(judged), loss, threads_);
}

/// The first start is the user's. Others are anywhere between bounds, or from a tenth of the user's to ten
/// times that.
std::vector<double> Fit::starting_point(int start) const {
  std::vector<double> scaled;
  const double stream = random_stream(study_.seed, "fit." + fit_.name);
  for (std::size_t p = 0; p < unknowns_.size(); ++p) {
    const Unknown& u = unknowns_[p];
    double value = u.start;
    if (start > 0) {
      const double part =
          uniform_number(stream, static_cast<double>(start) * 1024.0 + static_cast<double>(p));
      const bool bounded = std::isfinite(u.lower) && std::isfinite(u.upper);
      value = bounded          ? u.lower + part * (u.upper - u.lower)
              : u.start != 0.0 ? u.start * std::pow(10.0, 2.0 * part - 1.0)
                               : u.scale * (2.0 * part - 1.0);
    }
    scaled.push_back(std::clamp(value, u.lower, u.upper) / u.scale);
  }
  return scaled;
}

LeastSquaresSolution Fit::solve(int start) {
  LeastSquaresProblem problem;
  problem.evaluate = [&](std::span<const double> x, double* residuals, double* jacobian) {
    return objective_.evaluate(x, residuals, jacobian);
  };
  problem.residuals = objective_.size();
  problem.start = starting_point(start);
  for (const Unknown& u : unknowns_) {
    problem.lower.push_back(u.lower / u.scale);
    problem.upper.push_back(u.upper / u.scale);
  }
  problem.max_iterations = fit_.max_iterations;
  const int before = result_.iterations;
  problem.progress = [&, before](int iteration, double cost) {
    if (start == 0 && iteration == 0) keep_curves(&FittedSignal::before);
    return !progress_ || progress_(before + iteration, cost);
  };
  LeastSquaresSolution solution = minimise(problem);
  if (std::isnan(solution.cost)) solution.reason = "the start cannot be simulated: " + objective_.failure();
  result_.iterations += solution.iterations;
  return solution;
}

void Fit::search() {
  const int starts = std::max(fit_.starts, 1);
  std::vector<double> costs;
  for (int start = 0; start < starts; ++start) {
    LeastSquaresSolution solution = solve(start);
    if (start == 0) result_.cost_before = solution.cost_before;
    costs.push_back(solution.cost);
    const bool interrupted = solution.interrupted;
    if (start == 0 || solution.cost < best_.cost || std::isnan(best_.cost)) best_ = std::move(solution);
    if (interrupted) break;
  }
  if (costs.size() < 2) return;
  const auto same = std::ranges::count_if(costs, [&](double c) { return c <= best_.cost * (1.0 + 1e-6); });
  result_.remarks.push_back(
      fmt::format("{} of {} starts ended at the least cost, {:.6g}", same, costs.size(), best_.cost));
}

void Fit::fill_parameters() {
  for (std::size_t p = 0; p < unknowns_.size(); ++p) {
    const Unknown& u = unknowns_[p];
    const double value = best_.x[p] * u.scale, near = at_bound * u.scale;
    const bool bound = value - u.lower <= near || u.upper - value <= near;
    result_.parameters.push_back(
        {u.name, u.unit, u.start, value, std::numeric_limits<double>::quiet_NaN(), bound});
  }
}

void Fit::keep_curves(std::vector<double> FittedSignal::*curve) {
  const auto with_data = [](const FitExperiment& e) { return !e.data.empty(); };
  if (result_.experiments.empty()) {
    for (const FitExperiment& experiment : fit_.experiments) {
      if (with_data(experiment)) result_.experiments.push_back({experiment.name, experiment.data, {}, {}});
    }
  }
  std::size_t k = 0;
  for (const FitExperiment& experiment : fit_.experiments) {
    if (!with_data(experiment)) continue;
    ComparedRun& run = objective_.runs()[k];
    FittedExperiment& kept = result_.experiments[k++];
    const std::size_t width = experiment.matches.size();
    kept.times = run.measured.times;
    kept.signals.resize(width);
    for (std::size_t m = 0; m < width; ++m) {
      const auto& columns = study_.models[fit_.model].plan->columns;
      const auto column = std::ranges::find(columns, experiment.matches[m].signal, &LogColumn::name);
      kept.signals[m].signal = column->name;
      kept.signals[m].column = experiment.matches[m].column;
      kept.signals[m].unit = column->unit;
      std::vector<double>& values = kept.signals[m].*curve;
      values.clear();
      kept.signals[m].data.clear();
      for (std::size_t i = m; i < run.measured.values.size(); i += width) {
        kept.signals[m].data.push_back(run.measured.values[i]);
        values.push_back(run.model.values()[i]);
      }
    }
  }
}

/// At the point that was found, which need not be the last one that was tried.
void Fit::identify_parameters() {
  std::vector<double> residuals(static_cast<std::size_t>(objective_.size())), scales;
  std::vector<double> jacobian(residuals.size() * unknowns_.size());
  for (const Unknown& u : unknowns_) scales.push_back(u.scale);
  if (!objective_.evaluate(best_.x, residuals.data(), jacobian.data())) return;
  keep_curves(&FittedSignal::after);
  const auto rows = static_cast<std::size_t>(objective_.data_size());
  const bool exact = objective_.gradient() != "numeric";
  identify({{residuals.data(), rows}, {jacobian.data(), rows * unknowns_.size()}, scales, exact}, result_);
}

FitResult Fit::run() {
  search();
  result_.converged = best_.converged;
  result_.reason = best_.reason;
  result_.cost = best_.cost;
  result_.residuals = objective_.size();
  fill_parameters();
  if (!std::isnan(best_.cost)) identify_parameters();
  result_.simulations = objective_.simulations();
  result_.gradient = objective_.gradient();
  for (std::string& remark : objective_.remarks()) result_.remarks.push_back(std::move(remark));
  return result_;
}

}  // namespace

std::vector<Setting> FitResult::settings() const {
  std::vector<Setting> settings;
  for (const FittedParameter& p : parameters) settings.push_back({p.name, p.value});
  return settings;
}

FitResult run_fit(const Study& study, const FitDefinition& fit, Evaluator& evaluator, int threads,
                  const std::function<bool(int, double)>& progress) {
  return Fit(study, fit, evaluator, threads, progress).run();
}

}  // namespace flyball
