#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "benchmarks/flyball_run.h"
#include "benchmarks/table.h"
#include "solvers/lane_simulator.h"

namespace flyball::bench {
namespace {

// The stepper-driven robot on the trapezoid, as a tuner runs it: a tick of 1 ms, control every 5 ticks, the
// mean distance from the path at every tick and the mean error of the speed at every control step.
constexpr int runs = 40;
constexpr double tick = 1e-3, step_angle = 0.0065, wheel_diameter = 0.04, track_width = 0.054;
constexpr double wheel_speed_max = 3.25, v_reference = 0.04, transition = 0.027 * (1.0 + 1e-12);
constexpr long last_tick = 60000;
constexpr int control = 5, points = 5;
constexpr std::array<double, points> path_x{0.2, 0.6, 0.5, 0.3, 0.2}, path_y{0.2, 0.2, 0.6, 0.6, 0.2};

struct Gains {
  double k1, k2, k3, v_max, omega_max;
};

/// Gains around the published ones, all of which come to the last waypoint.
Gains gains(int run) {
  return {0.0247 + 0.004 * (run % 10), (2.9671 - 0.1 * (run / 10 % 10)) * 1e6, 552.0 + 5.0 * (run / 10),
          0.041 + 0.001 * (run % 7), 0.747 - 0.01 * (run % 5)};
}

struct Robot {
  Gains k;
  double x = 0.2, y = 0.2, theta = 0.0;
  double v = 0.0, right = 0.0, left = 0.0;  // commands
  double right_rest = 0.0, left_rest = 0.0;
  int next = 1;

  /// False when the last waypoint is reached.
  bool control_step() {
    while (next < points && std::hypot(path_x[next] - x, path_y[next] - y) <= transition) ++next;
    if (next == points) return false;
    const double dx = path_x[next] - x, dy = path_y[next] - y;
    const double c = std::cos(theta), s = std::sin(theta);
    const double way = std::atan2(path_y[next] - path_y[next - 1], path_x[next] - path_x[next - 1]);
    const double turned = std::remainder(way - theta, 2.0 * M_PI);
    double speed = v_reference * std::cos(turned) + k.k1 * (c * dx + s * dy);
    double turn = v_reference * (k.k2 * (c * dy - s * dx) + k.k3 * std::sin(turned));
    speed = std::clamp(speed, 0.0, k.v_max);
    turn = std::clamp(turn, -k.omega_max, k.omega_max);
    const double reach = wheel_diameter * wheel_speed_max / 2.0;
    const double fastest = std::fabs(speed) + track_width / 2.0 * std::fabs(turn);
    const double share = reach / std::max(fastest, reach);
    v = share * speed;
    right = (2.0 * v + track_width * share * turn) / wheel_diameter;
    left = (2.0 * v - track_width * share * turn) / wheel_diameter;
    return true;
  }

  static double step(double& rest, double speed) {
    rest += speed * tick;
    const double step = rest >= step_angle ? 1.0 : rest <= -step_angle ? -1.0 : 0.0;
    rest -= step_angle * step;
    rest -= std::trunc(rest / step_angle) * step_angle;
    return step_angle * step / tick;
  }

  void plant_step() {
    const double r = step(right_rest, right), l = step(left_rest, left);
    const double way = wheel_diameter / 4.0 * (r + l) * tick;
    x += way * std::cos(theta);
    y += way * std::sin(theta);
    theta += wheel_diameter / (2.0 * track_width) * (r - l) * tick;
  }

  double off_path() const {
    const double ax = path_x[next - 1], ay = path_y[next - 1];
    const double dx = path_x[next] - ax, dy = path_y[next] - ay;
    const double part = std::clamp(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
    const double ox = x - ax - part * dx, oy = y - ay - part * dy;
    return std::sqrt(ox * ox + oy * oy);
  }
};

/// Mean distance from the path, mean error of the speed, and how many ticks it took.
std::array<double, 3> simulate(const Gains& k) {
  Robot robot{k};
  double distances = 0.0, speed_errors = 0.0;
  long n = 0;
  for (; n < last_tick; ++n) {
    if (n % control == 0) {
      if (!robot.control_step()) break;
      speed_errors += std::fabs(robot.v - v_reference);
    }
    robot.plant_step();
    distances += robot.off_path();
  }
  const double ticks = static_cast<double>(n);
  return {distances / ticks, speed_errors / std::ceil(ticks / control), ticks * tick};
}

Contender twin() {
  auto found = std::make_shared<std::vector<double>>();
  Contender result;
  result.run = [=] {
    found->clear();
    for (int run = 0; run < runs; ++run) {
      for (const double value : simulate(gains(run))) found->push_back(value);
    }
  };
  result.result = [=] { return *found; };
  return result;
}

std::vector<ParameterSet> sets(const Plan& plan) {
  std::vector<ParameterSet> all;
  for (int run = 0; run < runs; ++run) {
    const Gains k = gains(run);
    all.push_back({{plan.parameter_slot("robot.k1"), k.k1},
                   {plan.parameter_slot("robot.k2"), k.k2},
                   {plan.parameter_slot("robot.k3"), k.k3},
                   {plan.parameter_slot("robot.v_max"), k.v_max},
                   {plan.parameter_slot("robot.omega_max"), k.omega_max}});
  }
  return all;
}

Contender ours() {
  const Model model = load("hilare/tuning.toml");
  const auto column = [&](const std::string& name) {
    const auto found = std::ranges::find(model.plan->columns, name, &LogColumn::name);
    if (found == model.plan->columns.end()) throw std::runtime_error("no column " + name);
    return found->slot;
  };
  const std::array<int, 3> slots{column("off_segment.mean"), column("speed_error.mean"), 0};
  auto found = std::make_shared<std::vector<double>>();
  Contender result;
  result.run = [=, sets = sets(*model.plan)] {
    found->clear();
    for (const LaneOutcome& outcome : run_in_lanes(model.plan, model.settings, sets)) {
      for (const int slot : slots) found->push_back(outcome.values[slot]);
    }
  };
  result.result = [=] { return *found; };
  return result;
}

}  // namespace

void add_stepper(std::vector<Workload>& workloads) {
  Workload w;
  w.name = "W8 stepper robot, 40 runs";
  w.must = 4.0;
  w.aim = 1.5;
  w.twin = [](double, double) { return twin(); };
  w.ours = [](double, double) { return ours(); };
  w.reference = [] {
    const Contender contender = twin();
    contender.run();
    return contender.result();
  };
  workloads.push_back(std::move(w));
}

}  // namespace flyball::bench
