#include "studies/fit/least_squares.h"

#include <ceres/ceres.h>
#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace flyball {
namespace {

bool all_finite(const double* numbers, std::size_t count) {
  return std::all_of(numbers, numbers + count, [](double x) { return std::isfinite(x); });
}

/// All residuals as one function of all unknowns.
class Residuals final : public ceres::CostFunction {
 public:
  explicit Residuals(const LeastSquaresProblem& problem) : problem_(problem) {
    set_num_residuals(problem.residuals);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(problem.start.size()));
  }
  bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override {
    double* const jacobian = jacobians == nullptr ? nullptr : jacobians[0];
    if (!problem_.evaluate({parameters[0], problem_.start.size()}, residuals, jacobian)) return false;
    // Ceres would complain about other numbers on standard error.
    const auto rows = static_cast<std::size_t>(problem_.residuals);
    return all_finite(residuals, rows) &&
           (jacobian == nullptr || all_finite(jacobian, rows * problem_.start.size()));
  }

 private:
  const LeastSquaresProblem& problem_;
};

class Progress final : public ceres::IterationCallback {
 public:
  explicit Progress(const LeastSquaresProblem& problem) : problem_(problem) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    if (summary.iteration == 0 || summary.step_is_successful) cost_ = summary.cost;
    const bool goes_on = !problem_.progress || problem_.progress(summary.iteration, cost_);
    return goes_on ? ceres::SOLVER_CONTINUE : ceres::SOLVER_TERMINATE_SUCCESSFULLY;
  }

 private:
  const LeastSquaresProblem& problem_;
  double cost_ = 0.0;  // of the last step that was taken
};

ceres::Solver::Options solver_options(const LeastSquaresProblem& problem) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = problem.max_iterations;
  options.function_tolerance = 1e-15;
  options.parameter_tolerance = 1e-10;
  // A gradient has the size of the data: no absolute bound fits all.
  options.gradient_tolerance = 0.0;
  // A region where the model cannot be run may be far from where it is left.
  options.max_num_consecutive_invalid_steps = 20;
  options.logging_type = ceres::SILENT;
  // What was reached stays, also where the search fails in the end.
  options.update_state_every_iteration = true;
  return options;
}

void set_bounds(const LeastSquaresProblem& problem, double* x, ceres::Problem& solver) {
  for (int i = 0; i < static_cast<int>(problem.start.size()); ++i) {
    if (std::isfinite(problem.lower[i])) solver.SetParameterLowerBound(x, i, problem.lower[i]);
    if (std::isfinite(problem.upper[i])) solver.SetParameterUpperBound(x, i, problem.upper[i]);
  }
}

/// Ceres says why it ended in a sentence with numbers in it.
std::string reason_of(const ceres::Solver::Summary& summary, int max_iterations) {
  const std::string_view message = summary.message;
  if (summary.termination_type == ceres::USER_SUCCESS) return "interrupted";
  if (summary.termination_type == ceres::NO_CONVERGENCE)
    return fmt::format("stopped after {} iterations, as max_iterations says", max_iterations);
  if (message.starts_with("Function")) return "the cost falls no more";
  if (message.starts_with("Parameter")) return "the parameters move no more";
  if (message.starts_with("Gradient")) return "the gradient is 0";
  if (message.starts_with("Trust region") || message.starts_with("Minimum trust"))
    return "no step, however short, lowers the cost";
  return summary.message;
}

/// Ceres logs failures to standard error, whatever its options say; here they are part of the answer.
void silence_log() {
  static const bool once = [] {
    FLAGS_minloglevel = google::GLOG_FATAL;
    return true;
  }();
  static_cast<void>(once);
}

}  // namespace

LeastSquaresSolution minimise(const LeastSquaresProblem& problem) {
  silence_log();
  LeastSquaresSolution solution;
  solution.x = problem.start;
  for (std::size_t i = 0; i < solution.x.size(); ++i)
    solution.x[i] = std::clamp(solution.x[i], problem.lower[i], problem.upper[i]);
  double* const x = solution.x.data();
  Residuals residuals(problem);
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem solver(ownership);
  solver.AddResidualBlock(&residuals, nullptr, x);
  set_bounds(problem, x, solver);
  ceres::Solver::Options options = solver_options(problem);
  Progress progress(problem);
  options.callbacks.push_back(&progress);

  ceres::Solver::Summary summary;
  ceres::Solve(options, &solver, &summary);
  solution.converged = summary.termination_type == ceres::CONVERGENCE;
  solution.interrupted = summary.termination_type == ceres::USER_SUCCESS;
  solution.reason = reason_of(summary, problem.max_iterations);
  const bool began = summary.initial_cost >= 0.0;
  solution.cost_before = began ? summary.initial_cost : std::numeric_limits<double>::quiet_NaN();
  solution.cost = summary.final_cost >= 0.0 ? summary.final_cost : solution.cost_before;
  solution.iterations = std::max(0, static_cast<int>(summary.iterations.size()) - 1);
  return solution;
}

}  // namespace flyball
