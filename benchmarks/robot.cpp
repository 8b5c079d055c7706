#include <cmath>
#include <memory>

#include "benchmarks/dopri5.h"
#include "benchmarks/flyball_run.h"

namespace flyball::bench {
namespace {

constexpr double stop = 60.0, seconds_a_line = 20.0, rows_per_second = 100.0;
constexpr long rows = 6001;

struct Line {
  double x, y, cosine, sine, heading;
};

constexpr Line lines[] = {
    {0.0, 0.0, 1.0, 0.0, 0.0}, {10.0, 0.0, 0.0, 1.0, M_PI_2}, {10.0, 10.0, -1.0, 0.0, M_PI}};

/// A differential drive that follows a line. States: x, y, heading.
struct Robot {
  using State = std::array<double, 3>;
  Line line = lines[0];

  static double limited(double speed) { return std::min(0.8, std::max(-0.8, speed)); }

  void operator()(double, const State& x, State& dx) const {
    const double offset = (x[1] - line.y) * line.cosine - (x[0] - line.x) * line.sine;
    const double angle = x[2] - line.heading;
    const double turn = -(offset + 2.0 * std::atan2(std::sin(angle), std::cos(angle)));
    const double right = limited(0.5 + 0.2 * turn), left = limited(0.5 - 0.2 * turn);
    const double speed = 0.5 * (right + left);
    dx[0] = speed * std::cos(x[2]);
    dx[1] = speed * std::sin(x[2]);
    dx[2] = (right - left) / 0.4;
  }
};

using Solver = Dopri5<3, Robot>;

/// Rows of the last step, from number `row` on and before its end. Returns the next row's number.
long log_step(const Solver& solver, long row, double* log) {
  const Quartic x = solver.extension(0), y = solver.extension(1), heading = solver.extension(2);
  const long last = std::lround(std::ceil(solver.end() * rows_per_second));
  const double interval = 1.0 / rows_per_second, scale = 1.0 / solver.size();
  for (; row < last; ++row) {
    const double theta = (static_cast<double>(row) * interval - solver.begin()) * scale;
    log[3 * row] = x(theta);
    log[3 * row + 1] = y(theta);
    log[3 * row + 2] = heading(theta);
  }
  return row;
}

void simulate(double rtol, double atol, double* log) {
  Solver solver(Robot{}, rtol, atol, 1e-3, stop);
  Solver::State start{0.0, -0.5, 0.0};
  long row = 0;
  for (int k = 0; k < 3; ++k) {
    solver.rates.line = lines[k];
    const double end = (k + 1) * seconds_a_line;
    solver.restart(k * seconds_a_line, start);
    while (solver.step(end) < end) row = log_step(solver, row, log);
    row = log_step(solver, row, log);
    start = solver.state();
  }
  std::copy_n(start.begin(), 3, log + 3 * row);
}

Contender twin(double rtol, double atol) {
  auto log = std::make_shared<std::vector<double>>();
  Contender result;
  result.run = [=] {
    log->resize(3 * rows);
    simulate(rtol, atol, log->data());
  };
  result.result = [=] { return *log; };
  return result;
}

}  // namespace

void add_robot(std::vector<Workload>& workloads) {
  Workload w;
  w.name = "W2 robot";
  w.must = 5.0;
  w.aim = 2.0;
  w.twin = twin;
  w.ours = [](double rtol, double atol) {
    return contender(load("benchmarks/robot.toml"), rtol, atol,
                     [](const Simulator& simulator) { return logged(simulator, rows); });
  };
  workloads.push_back(std::move(w));
}

}  // namespace flyball::bench
