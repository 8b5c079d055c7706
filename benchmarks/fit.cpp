#include <ceres/ceres.h>
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>

#include "benchmarks/dopri5.h"
#include "benchmarks/flyball_run.h"
#include "benchmarks/table.h"
#include "studies/fit/fit.h"

namespace flyball::bench {
namespace {

constexpr double stop = 10.0, step_time = 1.0;
constexpr int rows = 1001;
constexpr double rows_per_second = 100.0;
const std::vector<double> truth = {6.0, 4.0, 2.0}, start = {3.0, 1.0, 0.5};

/// The loop of loop.cpp with its gains on any scalar. States: integral, filtered error, v, y.
template <class T>
struct TunedLoop {
  T Kp, Ki, Kd;
  double reference = 0.0;

  void operator()(double, const std::array<T, 4>& x, std::array<T, 4>& dx) const {
    const T error = reference - x[3];
    const T d = 50.0 * (Kd * error - x[1]);
    T effort = Kp * error + x[0] + d;
    if (effort > 5.0) effort = T(5.0);
    if (effort < -5.0) effort = T(-5.0);
    dx[0] = Ki * error;
    dx[1] = d;
    dx[2] = 4.0 * (effort - x[3]) - 1.2 * x[2];
    dx[3] = x[2];
  }
};

/// y at 100 Hz.
template <class T>
void simulate(const T* gains, double rtol, double atol, T* y) {
  Dopri5<4, TunedLoop<T>, T> solver({gains[0], gains[1], gains[2]}, rtol, atol, 1e-3, stop);
  int row = 0;
  for (const double end : {step_time, stop}) {
    solver.restart(solver.end(), solver.state());
    for (bool more = true; more;) {
      more = solver.step(end) < end;
      const auto extension = solver.extension(3);
      const int last = static_cast<int>(std::ceil(solver.end() * rows_per_second));
      for (; row < last; ++row) y[row] = extension((row / rows_per_second - solver.begin()) / solver.size());
    }
    solver.rates.reference = 1.0;
  }
  y[row] = solver.state()[3];
}

std::vector<double> measured() {
  std::vector<double> y(rows);
  simulate(truth.data(), 1e-12, 1e-14, y.data());
  return y;
}

/// Values on numbers, and on Jets where derivatives are wanted, as Ceres' own AutoDiffCostFunction has it.
class Residuals final : public ceres::SizedCostFunction<rows, 3> {
 public:
  Residuals(double rtol, double atol) : rtol_(rtol), atol_(atol) {}
  bool Evaluate(const double* const* gains, double* residuals, double** jacobians) const override {
    ++simulations;
    if (jacobians == nullptr || jacobians[0] == nullptr) {
      simulate(gains[0], rtol_, atol_, residuals);
      for (int k = 0; k < rows; ++k) residuals[k] -= data_[k];
      return true;
    }
    using Jet = ceres::Jet<double, 3>;
    const Jet k[3] = {{gains[0][0], 0}, {gains[0][1], 1}, {gains[0][2], 2}};
    simulate(k, rtol_, atol_, jets_.data());
    for (int row = 0; row < rows; ++row) {
      residuals[row] = jets_[row].a - data_[row];
      for (int p = 0; p < 3; ++p) jacobians[0][3 * row + p] = jets_[row].v[p];
    }
    return true;
  }

  mutable int simulations = 0;

 private:
  double rtol_, atol_;
  std::vector<double> data_ = measured();
  mutable std::vector<ceres::Jet<double, 3>> jets_ = std::vector<ceres::Jet<double, 3>>(rows);
};

std::vector<double> fit_by_hand(Residuals& residuals) {
  std::vector<double> gains = start;
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  problem.AddResidualBlock(&residuals, nullptr, gains.data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.function_tolerance = 1e-12;
  options.parameter_tolerance = 1e-10;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return gains;
}

Contender twin(double rtol, double atol) {
  auto residuals = std::make_shared<Residuals>(rtol, atol);
  auto last = std::make_shared<std::vector<double>>();
  Contender result;
  result.run = [=] {
    residuals->simulations = 0;
    *last = fit_by_hand(*residuals);
  };
  result.result = [=] { return *last; };
  result.rate_evaluations = [=] { return static_cast<long>(residuals->simulations); };
  return result;
}

/// The study that `flyball fit` makes, and its file of data while it lives.
struct FitStudy {
  FitStudy() {
    std::ofstream file(data);
    file << "time,y\n";
    const std::vector<double> y = measured();
    for (int k = 0; k < rows; ++k) file << fmt::format("{},{}\n", k / rows_per_second, y[k]);
    study.models.push_back({"loop", "loop.toml", "", load("benchmarks/loop.toml").plan, {}, {}});
    const char* names[] = {"proportional.gain", "integral_gain.gain", "derivative_gain.gain"};
    for (int p = 0; p < 3; ++p) fit.parameters.push_back({names[p], -infinity, infinity, start[p]});
    fit.experiments.push_back({"step", data, {{"position", "y", 1.0}}, {}});
  }
  ~FitStudy() { std::filesystem::remove(data); }
  FitStudy(const FitStudy&) = delete;
  FitStudy& operator=(const FitStudy&) = delete;

  std::string data = std::filesystem::temp_directory_path() / fmt::format("flyball_bench_{}.csv", getpid());
  Study study;
  FitDefinition fit;
  FitResult result;
};

/// At its own tolerance, whatever the twin's is.
Contender ours(double, double) {
  auto fit = std::make_shared<FitStudy>();
  Contender result;
  result.run = [=] {
    Evaluator evaluator(fit->study.models);
    fit->result = run_fit(fit->study, fit->fit, evaluator);
  };
  result.result = [=] {
    std::vector<double> gains;
    for (const FittedParameter& p : fit->result.parameters) gains.push_back(p.value);
    return gains;
  };
  result.rate_evaluations = [=] { return static_cast<long>(fit->result.simulations); };
  return result;
}

}  // namespace

void add_fit(std::vector<Workload>& workloads) {
  Workload w;
  w.name = "W7 fit";
  w.must = 4.0;
  w.aim = 1.5;
  w.rtol = 1e-10;
  w.twin = twin;
  w.ours = ours;
  w.reference = [] { return truth; };
  workloads.push_back(w);
}

void print_fit() {
  const Contender hand = twin(1e-10, 1e-12), fit = ours(1e-10, 1e-12);
  hand.run();
  fit.run();
  fmt::print(
      "{:<24}twin {} simulations, error {:.1e}; Flyball {} simulations with derivatives, error {:.1e}\n",
      "W7 simulations", hand.rate_evaluations(), error_of(hand.result(), truth), fit.rate_evaluations(),
      error_of(fit.result(), truth));
}

}  // namespace flyball::bench
