#include <cmath>
#include <memory>

#include "benchmarks/dopri5.h"
#include "benchmarks/flyball_run.h"

namespace flyball::bench {
namespace {

constexpr double stop = 100.0, step_time = 1.0;

/// PID with a filtered derivative and a second-order plant. States: integral, filtered error, v, y.
struct Loop {
  using State = std::array<double, 4>;
  double reference = 0.0;

  static double effort(double error, double integral, double derivative) {
    return std::min(5.0, std::max(-5.0, 6.0 * error + integral + derivative));
  }
  double derivative(double error, double filtered) const { return 50.0 * (2.0 * error - filtered); }

  void operator()(double, const State& x, State& dx) const {
    const double error = reference - x[3];
    const double d = derivative(error, x[1]);
    dx[0] = 4.0 * error;
    dx[1] = d;
    dx[2] = 4.0 * (effort(error, x[0], d) - x[3]) - 1.2 * x[2];
    dx[3] = x[2];
  }
  void log(double integral, double filtered, double y, double* row) const {
    const double error = reference - y;
    row[0] = y;
    row[1] = effort(error, integral, derivative(error, filtered));
  }
};

using Solver = Dopri5<4, Loop>;

/// Rows of the last step, from number `row` on and before its end. Returns the next row's number.
long log_step(const Solver& solver, double rows_per_second, long row, double* log) {
  const Quartic integral = solver.extension(0), filtered = solver.extension(1), y = solver.extension(3);
  const long last = static_cast<long>(std::ceil(solver.end() * rows_per_second));
  const double interval = 1.0 / rows_per_second, scale = 1.0 / solver.size();
  for (; row < last; ++row) {
    const double theta = (static_cast<double>(row) * interval - solver.begin()) * scale;
    solver.rates.log(integral(theta), filtered(theta), y(theta), log + 2 * row);
  }
  return row;
}

void simulate(double rtol, double atol, double rows_per_second, double* log) {
  Solver solver(Loop{}, rtol, atol, 1e-3, stop);
  long row = 0;
  for (const double end : {step_time, stop}) {
    solver.restart(solver.end(), solver.state());
    while (solver.step(end) < end) row = log_step(solver, rows_per_second, row, log);
    row = log_step(solver, rows_per_second, row, log);
    solver.rates.reference = 1.0;
  }
  const Solver::State& x = solver.state();
  solver.rates.log(x[0], x[1], x[3], log + 2 * row);
}

Contender twin(double rtol, double atol, double rows_per_second) {
  const auto numbers = static_cast<std::size_t>(2 * (std::lround(stop * rows_per_second) + 1));
  auto log = std::make_shared<std::unique_ptr<double[]>>();
  Contender result;
  result.run = [=] {
    *log = std::make_unique_for_overwrite<double[]>(numbers);
    simulate(rtol, atol, rows_per_second, log->get());
  };
  result.result = [=] { return std::vector<double>(log->get(), log->get() + numbers); };
  return result;
}

Workload workload(const std::string& name, long rows_per_second, double must, double aim) {
  Workload w;
  w.name = name;
  w.must = must;
  w.aim = aim;
  w.twin = [=](double rtol, double atol) { return twin(rtol, atol, static_cast<double>(rows_per_second)); };
  w.ours = [=](double rtol, double atol) {
    Model model = load("benchmarks/loop.toml");
    model.settings.log_interval = divide(Rational(1), Rational(rows_per_second));
    const long rows = std::lround(stop) * rows_per_second + 1;
    return contender(model, rtol, atol, [=](const Simulator& s) { return logged(s, rows); });
  };
  return w;
}

}  // namespace

void add_loop(std::vector<Workload>& workloads) {
  workloads.push_back(workload("W1 loop, log 1 kHz", 1000, 4.0, 1.5));
  workloads.push_back(workload("W1 loop, log 1 Hz", 1, 5.0, 2.0));
}

}  // namespace flyball::bench
