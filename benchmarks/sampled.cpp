#include <cmath>
#include <memory>
#include <unsupported/Eigen/MatrixFunctions>

#include "benchmarks/dopri5.h"
#include "benchmarks/flyball_run.h"

namespace flyball::bench {
namespace {

constexpr double R = 2.0, L = 1e-3, K = 0.05, J = 5e-5, b = 1e-5;
constexpr double sample_time = 1e-3, load_torque = 0.02;
constexpr long hits = 10000, loaded_from = 5000;

/// States: current, angular speed, angle.
struct Motor {
  using State = std::array<double, 3>;
  double voltage = 0.0, torque = 0.0;

  void operator()(double, const State& x, State& dx) const {
    dx[0] = (voltage - R * x[0] - K * x[1]) * (1.0 / L);
    dx[1] = (K * x[0] - b * x[1] - torque) * (1.0 / J);
    dx[2] = x[1];
  }
};

class Controller {
 public:
  double operator()(double speed) {
    const double error = 100.0 - speed;
    integral_ += 10.0 * sample_time * error;
    const double derivative = 1e-4 / sample_time * (error - last_error_);
    last_error_ = error;
    return std::min(24.0, std::max(-24.0, 0.5 * error + integral_ + derivative));
  }

 private:
  double integral_ = 0.0, last_error_ = 0.0;
};

double torque_at(long hit) { return hit < loaded_from ? 0.0 : load_torque; }

void simulate(double rtol, double atol, double* log) {
  Dopri5<3, Motor> solver(Motor{}, rtol, atol, 1e-4, sample_time);
  Controller controller;
  for (long k = 0; k < hits; ++k) {
    log[k] = solver.state()[1];
    solver.rates.voltage = controller(log[k]);
    solver.rates.torque = torque_at(k);
    solver.restart(static_cast<double>(k) * sample_time, solver.state());
    const double next = static_cast<double>(k + 1) * sample_time;
    while (solver.step(next) < next) {
    }
  }
  log[hits] = solver.state()[1];
}

/// From hit to hit by the matrix exponential of the motor and its two held inputs.
void simulate_exactly(double* log) {
  Eigen::Matrix<double, 5, 5> A = Eigen::Matrix<double, 5, 5>::Zero();
  A.row(0) << -R / L, -K / L, 0.0, 1.0 / L, 0.0;
  A.row(1) << K / J, -b / J, 0.0, 0.0, -1.0 / J;
  A.row(2) << 0.0, 1.0, 0.0, 0.0, 0.0;
  const Eigen::Matrix<double, 5, 5> step = (A * sample_time).exp();
  const Eigen::Matrix<double, 3, 5> M = step.topRows<3>();
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  Controller controller;
  for (long k = 0; k < hits; ++k) {
    log[k] = x[1];
    const double voltage = controller(x[1]);
    x = M.leftCols<3>() * x + M.col(3) * voltage + M.col(4) * torque_at(k);
  }
  log[hits] = x[1];
}

template <class Simulate>
Contender twin(Simulate simulate_into) {
  auto log = std::make_shared<std::unique_ptr<double[]>>();
  Contender result;
  result.run = [=] {
    *log = std::make_unique_for_overwrite<double[]>(hits + 1);
    simulate_into(log->get());
  };
  result.result = [=] { return std::vector<double>(log->get(), log->get() + hits + 1); };
  return result;
}

}  // namespace

void add_sampled(std::vector<Workload>& workloads) {
  Workload w;
  w.name = "W3 sampled DC motor";
  w.must = 3.0;
  w.aim = 0.1;
  w.twin = [](double rtol, double atol) { return twin([=](double* log) { simulate(rtol, atol, log); }); };
  w.exact_twin = [] { return twin(simulate_exactly); };
  w.ours = [](double rtol, double atol) {
    return contender(load("classic/sampled_dc_motor.toml"), rtol, atol,
                     [](const Simulator& s) { return logged(s, hits + 1); });
  };
  w.reference = [exact = w.exact_twin] {
    const Contender contender = exact();
    contender.run();
    return contender.result();
  };
  workloads.push_back(std::move(w));
}

}  // namespace flyball::bench
