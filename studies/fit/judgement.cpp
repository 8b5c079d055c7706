#include "studies/fit/judgement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "studies/fit/quadratic_residuals.h"

namespace flyball {
namespace {

constexpr double tolerance = 1e-10;

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Judgement::Judgement(const Study& study, const FitDefinition& fit, const std::vector<Unknown>& unknowns,
                     std::vector<std::vector<Setting>> runs, Evaluator& evaluator, int threads)
    : study_(study),
      fit_(fit),
      unknowns_(unknowns),
      runs_(std::move(runs)),
      evaluator_(evaluator),
      threads_(threads),
      seed_(study.models[fit.model].plan->diagram->simulation.seed) {
  const SimulationSettings& simulation = study.models[fit.model].plan->diagram->simulation;
  const double rtol = std::min(simulation.rtol, tolerance);
  for (std::vector<Setting>& settings : runs_) {
    settings.push_back({"simulation.rtol", rtol});
    settings.push_back({"simulation.atol", simulation.atol * rtol / simulation.rtol});
  }
}

int Judgement::size() const {
  const std::size_t each = fit_.requirements.size() + fit_.minimise.size() * (unknowns_.size() + 1);
  return static_cast<int>(runs_.size() * each);
}

bool Judgement::evaluate(std::span<const double> parameters, double* residuals, double* jacobian) {
  using Order = Stencil::Order;
  const Order order = jacobian == nullptr     ? Order::value
                      : fit_.minimise.empty() ? Order::gradient
                                              : Order::hessian;
  const Stencil stencil(unknowns_, parameters, order);
  const std::vector<RunRecord> all = run_all(stencil);
  const std::size_t points = stencil.points().size(), n = unknowns_.size();
  const auto advance = [&](std::size_t rows) {
    residuals += rows;
    if (jacobian != nullptr) jacobian += rows * n;
  };
  for (std::size_t run = 0; run < runs_.size(); ++run) {
    const std::span<const RunRecord> records(all.data() + run * points, points);
    if (records[0].status != RunStatus::finished) {
      failure_ = records[0].reason;
      return false;
    }
    for (const int requirement : fit_.requirements) {
      if (!judge_requirement(requirement, records, stencil, residuals, jacobian)) return false;
      advance(1);
    }
    for (const int metric : fit_.minimise) {
      if (!judge_metric(metric, records, stencil, residuals, jacobian)) return false;
      advance(n + 1);
    }
  }
  return true;
}

std::vector<RunRecord> Judgement::run_all(const Stencil& stencil) {
  std::vector<RunRequest> requests;
  for (const std::vector<Setting>& settings : runs_) {
    for (const std::vector<double>& point : stencil.points()) requests.push_back(request(settings, point));
  }
  simulations_ += static_cast<int>(requests.size());
  EvaluatorOptions options;
  options.threads = threads_;
  return evaluator_.run(requests, options);
}

RunRequest Judgement::request(const std::vector<Setting>& settings, const std::vector<double>& point) const {
  RunRequest result{fit_.model, settings, seed_};
  for (std::size_t p = 0; p < point.size(); ++p) result.settings.push_back({unknowns_[p].name, point[p]});
  return result;
}

bool Judgement::judge_requirement(int requirement, std::span<const RunRecord> records, const Stencil& stencil,
                                  double* residual, double* row) {
  std::vector<double> margins;
  for (const RunRecord& record : records) {
    const bool finished = record.status == RunStatus::finished;
    margins.push_back(finished ? record.verdicts[requirement].margin : missing);
  }
  if (std::isnan(margins[0])) {
    failure_ = fmt::format("the requirement {} has no margin: {}", study_.requirements[requirement].first,
                           records[0].verdicts[requirement].message);
    return false;
  }
  const bool broken = margins[0] < 0.0;
  *residual = broken ? margins[0] : 0.0;
  if (row == nullptr) return true;
  Eigen::Map<Eigen::VectorXd> derivatives(row, static_cast<Eigen::Index>(unknowns_.size()));
  derivatives.setZero();
  if (broken) derivatives = stencil.gradient(margins);
  return derivatives.allFinite();
}

bool Judgement::judge_metric(int metric, std::span<const RunRecord> records, const Stencil& stencil,
                             double* residuals, double* rows) {
  std::vector<double> values;
  for (const RunRecord& record : records)
    values.push_back(record.status == RunStatus::finished ? record.metrics[metric] : missing);
  if (!(values[0] >= 0.0) || std::isinf(values[0])) {
    failure_ = fmt::format("the metric {} is {}, and only what is not negative can be minimised by a fit",
                           study_.metrics[metric].first, values[0]);
    return false;
  }
  const auto n = static_cast<Eigen::Index>(unknowns_.size());
  Eigen::Map<Eigen::VectorXd> r(residuals, n + 1);
  r.setZero();
  r[n] = std::sqrt(values[0]);
  if (rows == nullptr) return true;
  const Eigen::VectorXd gradient = stencil.gradient(values);
  if (!gradient.allFinite()) {
    failure_ = fmt::format("the metric {} has no derivative", study_.metrics[metric].first);
    return false;
  }
  const QuadraticResiduals quadratic(values[0], gradient, stencil.hessian(values));
  r = quadratic.residuals;
  Eigen::Map<RowMajor>(rows, n + 1, n) = quadratic.jacobian;
  return true;
}

}  // namespace flyball
