#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "benchmarks/dopri5.h"
#include "benchmarks/flyball_run.h"

namespace flyball::bench {
namespace {

constexpr int events = 1000;
constexpr double gravity = 9.81, ball_stop = 903.0, relay_stop = 406.0;

/// The root in (0, 1] beyond which `q` has the sign of q(1): Newton's method from there, in a bracket.
double last_root(const Quartic& q) {
  double before = 0.0, after = 1.0, theta = 1.0;
  const double sign = q(1.0);
  for (int k = 0; k < 60; ++k) {
    const double value = q(theta);
    (value * sign > 0.0 ? after : before) = theta;
    const double slope = q.c1 + theta * (2.0 * q.c2 + theta * (3.0 * q.c3 + theta * 4.0 * q.c4));
    double next = theta - value / slope;
    if (!(next > before && next < after)) next = 0.5 * (before + after);
    const double change = std::fabs(next - theta);
    theta = next;
    if (change < 1e-15) break;
  }
  return theta;
}

/// States: height, velocity.
struct Ball {
  void operator()(double, const std::array<double, 2>& x, std::array<double, 2>& dx) const {
    dx[0] = x[1];
    dx[1] = -gravity;
  }
};

void bounce(double rtol, double atol, double* times) {
  // A flight takes 0.903 s: one step each.
  Dopri5<2, Ball> solver(Ball{}, rtol, atol, 1e-2, 1.0);
  solver.restart(0.0, {1.0, 0.0});
  for (int k = 0; solver.end() < ball_stop;) {
    solver.step(ball_stop);
    if (solver.state()[0] >= 0.0) continue;
    const double theta = last_root(solver.extension(0));
    const double t = solver.begin() + theta * solver.size();
    times[k++] = t;
    solver.restart(t, {0.0, -solver.extension(1)(theta)});
  }
}

struct Lag {
  double u = 1.0;

  void operator()(double, const std::array<double, 1>& x, std::array<double, 1>& dx) const {
    dx[0] = u - x[0];
  }
};

void switch_relay(double rtol, double atol, double* times) {
  Dopri5<1, Lag> solver(Lag{}, rtol, atol, 1e-2, 1.0);
  solver.restart(0.0, {0.0});
  for (int k = 0; solver.end() < relay_stop;) {
    solver.step(relay_stop);
    const bool rises = solver.rates.u > 0.0;
    const double level = rises ? 0.6 : 0.4;
    if (rises ? solver.state()[0] <= level : solver.state()[0] >= level) continue;
    Quartic distance = solver.extension(0);
    distance.c0 -= level;
    const double theta = last_root(distance);
    const double t = solver.begin() + theta * solver.size();
    times[k++] = t;
    solver.rates.u = 1.0 - solver.rates.u;
    solver.restart(t, {level});
  }
}

Contender twin(double rtol, double atol, void (*simulate)(double, double, double*)) {
  // Room for the few events too many that a loose tolerance may give.
  auto times = std::make_shared<std::array<double, 2 * events>>();
  Contender result;
  result.run = [=] { simulate(rtol, atol, times->data()); };
  result.result = [=] { return std::vector<double>(times->begin(), times->begin() + events); };
  return result;
}

/// The times at which the logged signal jumped: all rows but those at the start and at the stop time.
std::vector<double> jumps(const Simulator& simulator) {
  const Log& log = simulator.log();
  if (log.rows() != events + 2)
    throw std::runtime_error(fmt::format("{} rows, expected {}", log.rows(), events + 2));
  std::vector<double> times;
  for (long row = 1; row <= events; ++row) times.push_back(log.time(row));
  return times;
}

Workload workload(const std::string& name, const std::string& path, long stop,
                  void (*simulate)(double, double, double*)) {
  Workload w;
  w.name = name;
  w.must = 4.0;
  w.aim = 1.5;
  w.twin = [=](double rtol, double atol) { return twin(rtol, atol, simulate); };
  w.ours = [=](double rtol, double atol) {
    Model model = load(path);
    // Only the events: what the twin keeps, too.
    model.settings.log_interval = Rational(stop);
    model.log.event_rows = EventRows::after;
    return contender(model, rtol, atol, jumps);
  };
  return w;
}

std::vector<double> event_times(double first, double interval) {
  std::vector<double> times;
  for (int k = 0; k < events; ++k) times.push_back(first + k * interval);
  return times;
}

}  // namespace

void add_events(std::vector<Workload>& workloads) {
  Workload ball =
      workload("W6a elastic ball", "benchmarks/elastic_ball.toml", std::lround(ball_stop), bounce);
  const double fall = std::sqrt(2.0 / gravity);
  ball.reference = [=] { return event_times(fall, 2.0 * fall); };
  workloads.push_back(std::move(ball));

  Workload relay = workload("W6b relay", "benchmarks/relay.toml", std::lround(relay_stop), switch_relay);
  relay.reference = [] { return event_times(std::log(2.5), std::log(1.5)); };
  workloads.push_back(std::move(relay));
}

}  // namespace flyball::bench
