#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "tests/source_dir.h"
#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Model shipped(const std::string& name, const std::vector<Override>& overrides = {}) {
  return load_model(source_dir() + "/models/" + name + ".toml", overrides);
}

/// In units of the tolerance of the run: the measure by which its solver accepted each step.
double weighted(double value, double exact, const SimulationSettings& settings) {
  return std::fabs(value - exact) / (settings.atol + settings.rtol * std::fabs(exact));
}

/// The rows after which a logged signal has jumped.
std::vector<std::size_t> jumps(const std::vector<double>& times, const std::vector<double>& signal) {
  std::vector<std::size_t> rows;
  for (std::size_t k = 1; k < times.size(); ++k) {
    if (times[k] == times[k - 1] && signal[k] != signal[k - 1]) rows.push_back(k);
  }
  return rows;
}

MatrixXd exponential(const MatrixXd& matrix) { return matrix.exp(); }

}  // namespace

TEST_CASE("Bouncing ball: times and speeds of all bounces") {
  Run run(shipped("classic/bouncing_ball"));
  run.finish();
  const std::vector<double> t = run.times(), w = run.column("ball.velocity");
  const auto bounces = jumps(t, w);
  const double fall = std::sqrt(2.0 / 9.81), r = 0.8;
  double exact = fall, speed = 9.81 * fall;
  for (const std::size_t k : bounces) {
    // A parabola is exact for the method; roots are bracketed to 4 units in the last place of t < 4, and the
    // speed differs by 9.81 times that, from all bounces so far.
    CHECK(std::fabs(t[k] - exact) < 1e-12);
    speed *= r;
    CHECK(std::fabs(w[k] - speed) < 1e-12);
    exact += 2.0 * speed / 9.81;
  }
  // The next one would be after the stop time.
  CHECK(exact > 4.0);
  CHECK(bounces.size() == 19);
}

TEST_CASE("Thermostat: the closed form of all switching times") {
  Model model = shipped("classic/relay_thermostat");
  model.settings.rtol = 1e-10;
  Run run(model);
  run.finish();
  const double tau = 2e4, hot = 5.0 + 40.0, out = 5.0, low = 19.5, high = 20.5;
  const std::vector<double> t = run.times();
  const auto switches = jumps(t, run.column("thermostat"));
  const double tolerance = model.settings.atol + model.settings.rtol * 294.0;
  double exact = tau * std::log((hot - 15.0) / (hot - high));
  for (std::size_t n = 0; n < switches.size(); ++n) {
    // A tolerance of the temperature at each switch so far, over its slowest rate there, (19.5 - 5) K/tau.
    CHECK(std::fabs(t[switches[n]] - exact) < static_cast<double>(n + 1) * tolerance * tau / (low - out));
    exact +=
        n % 2 == 0 ? tau * std::log((high - out) / (low - out)) : tau * std::log((hot - low) / (hot - high));
  }
  CHECK(exact > model.settings.stop);
  CHECK(switches.size() == 23);
}

TEST_CASE("Smith predictor: the step response without dead time, a dead time later") {
  Run run(shipped("classic/smith_predictor"));
  run.finish();
  const SimulationSettings& settings = shipped("classic/smith_predictor").settings;
  for (int k = 0; k <= 500; ++k) {
    const double t = k / 100.0;
    const double exact = t < 1.0 ? 0.0 : 1.0 - std::exp(-4.0 * (t - 1.0));
    // The errors of some hundred steps, which the loop does not amplify.
    CHECK(weighted(run.logged("process", t), exact, settings) < 100.0);
  }
}

TEST_CASE("Valve: the controller takes over without a jump and fills the tank to the wanted level") {
  Run run(shipped("classic/valve_takeover"));
  run.finish();
  const std::vector<double> t = run.times(), u = run.column("controller");
  for (std::size_t k = 1; k < t.size() && t[k] <= 100.0; ++k) REQUIRE(std::fabs(u[k] - 0.6) < 1e-15);
  CHECK(jumps(t, u).empty());
  // A pole at -0.005 1/s has 1900 s: exp(-9.5) = 7e-5 of the error of 1 m.
  CHECK(std::fabs(run["level.x"] - 2.0) < 1e-3);
  // c f(x) = k h at h = 2 m: f = 0.4, on the line from (0.5, 0.15) to (0.8, 0.6).
  CHECK(std::fabs(u.back() - (0.5 + 0.3 * 0.25 / 0.45)) < 1e-3);
}

TEST_CASE("Van der Pol: the published period of the limit cycle") {
  // After 40 s the start has been forgotten: deviations shrink by 1200 a turn.
  const double period = 6.6632868593231301896996820305;
  Model model = shipped("classic/van_der_pol");
  model.settings.rtol = model.settings.atol = 1e-12;
  Model longer = model;
  model.settings.stop = 40.0;
  longer.settings.stop = 40.0 + period;
  Run first(model), second(longer);
  first.finish();
  second.finish();
  // Some 6000 steps may each shift the phase by a tolerance of at most 4e-12.
  CHECK(std::fabs(second["x.x"] - first["x.x"]) < 2.4e-8);
  CHECK(std::fabs(second["v.x"] - first["v.x"]) < 2.4e-8);
}

TEST_CASE("Van der Pol, stiff: the reference of the Test Set for IVP Solvers at 2000 s") {
  // Mazzia, Magherini: Test Set for Initial Value Problem Solvers, release 2.4, problem VDPOL.
  Model model = shipped("classic/van_der_pol_stiff");
  Run run(model);
  run.finish();
  // The local errors before the jumps shift them in time; while x creeps, that shift stays.
  CHECK(weighted(run["x.x"], 1.706167732170483, model.settings) < 100.0);
  CHECK(weighted(run["v.x"], -8.928097010247975e-4, model.settings) < 100.0);
  model.settings.rtol = 1e-9;
  model.settings.atol = 1e-12;
  Run tight(model);
  tight.finish();
  CHECK(weighted(tight["x.x"], 1.706167732170483, model.settings) < 100.0);
}

TEST_CASE("Robertson: the values at 40 s") {
  // dp5 at 1e-11 and BDF at 1e-12 agree on these digits. The slow reaction forgets nothing, and 300 steps of
  // random sign add up to a few tolerances.
  const Model model = shipped("classic/robertson");
  Run run(model);
  run.finish();
  CHECK(weighted(run["A.x"], 0.7158270687194, model.settings) < 5.0);
  CHECK(weighted(run["B.x"], 9.185534764557e-6, model.settings) < 5.0);
  CHECK(weighted(run["C.x"], 0.2841637457458, model.settings) < 5.0);
  // Linear invariants are kept by every method, to the rounding of some 300 steps.
  CHECK(std::fabs(run["A.x"] + run["B.x"] + run["C.x"] - 1.0) < 1e-13);
}

TEST_CASE("Lorenz: five seconds against another method at the tightest tolerance") {
  Model model = shipped("classic/lorenz");
  model.settings.stop = 5.0;
  Model reference = model;
  reference.settings.method = "adams";
  reference.settings.rtol = reference.settings.atol = 1e-13;
  Run run(model), exact(reference);
  run.finish();
  exact.finish();
  // Errors grow as exp(0.906 t): a tolerance lost at the start is 93 of them after 5 s.
  for (const std::string state : {"X.x", "Y.x", "Z.x"})
    CHECK(weighted(run[state], exact[state], model.settings) < 93.0);
}

TEST_CASE("PID servo: a small turn against the matrix exponential") {
  const Model model = shipped("classic/pid_servo", {{"angle", "0.1 rad"}});
  Run run(model);
  run.finish();
  const double J = 3.2284e-6, b = 3.5077e-6, K = 0.0274, R = 4.0, Kp = 21.0, Ki = 500.0, Kd = 0.15,
               N = 5000.0;
  // angle, speed, integral, filtered, wanted, load
  MatrixXd A = MatrixXd::Zero(6, 6);
  A(0, 1) = 1.0;
  A.row(1) << -(Kp + Kd * N), -K, 1.0, -Kd * N, Kp, 0.0;
  A.row(1) *= K / R / J;
  A(1, 1) -= b / J;
  A(1, 5) = -1.0 / J;
  A(2, 0) = -Ki;
  A(2, 4) = Ki;
  A(3, 0) = A(3, 3) = -N;
  const MatrixXd step = exponential(A * 1e-3);
  VectorXd x = VectorXd::Zero(6);
  double angle_error = 0.0, speed_error = 0.0, fastest = 0.0;
  for (int k = 0; k <= 600; ++k) {
    const double t = k / 1000.0;
    angle_error = std::max(angle_error, std::fabs(run.logged("shaft", t) - x(0)));
    speed_error = std::max(speed_error, std::fabs(run.logged("speed", t) - x(1)));
    fastest = std::max(fastest, std::fabs(x(1)));
    x(4) = t >= 0.01 ? 0.1 : 0.0;
    x(5) = t >= 0.3 ? 5e-3 : 0.0;
    x = step * x;
  }
  // The loop is stable and forgets: a tolerance of what angle and speed have been at most.
  CHECK(angle_error < 1e-10 + 1e-8 * 0.1);
  CHECK(speed_error < 1e-10 + 1e-8 * fastest);
  CHECK(run.simulator().statistics().events == 0);
}

namespace {

/// i, w, angle of a DC motor under a voltage and a load torque that are held for h seconds.
class HeldMotor {
 public:
  explicit HeldMotor(double h) {
    const double R = 2.0, L = 1e-3, K = 0.05, J = 5e-5, b = 1e-5;
    MatrixXd A = MatrixXd::Zero(5, 5);
    A.row(0) << -R / L, -K / L, 0.0, 1.0 / L, 0.0;
    A.row(1) << K / J, -b / J, 0.0, 0.0, -1.0 / J;
    A(2, 1) = 1.0;
    step_ = exponential(A * h);
  }
  double i() const { return x_(0); }
  double w() const { return x_(1); }
  void hold(double voltage, double load) {
    x_(3) = voltage;
    x_(4) = load;
    x_ = step_ * x_;
  }

 private:
  MatrixXd step_;
  VectorXd x_ = VectorXd::Zero(5);
};

}  // namespace

TEST_CASE("Sampled DC motor: exact discretisation at all hits") {
  const Model model = shipped("classic/sampled_dc_motor");
  Run run(model);
  run.finish();
  HeldMotor motor(1e-3);
  double integral = 0.0, last = 0.0, worst = 0.0;
  for (int k = 0; k <= 10000; ++k) {
    worst = std::max(worst, weighted(run.logged("speed", k / 1000.0), motor.w(), model.settings));
    const double e = 100.0 - motor.w();
    integral += 10.0 * 1e-3 * e;
    const double u = 0.5 * e + integral + 1e-4 * (e - last) / 1e-3;
    last = e;
    motor.hold(std::clamp(u, -24.0, 24.0), k >= 5000 ? 0.02 : 0.0);
  }
  // The loop forgets within some 10 ms, so no more than a step's own tolerance is left.
  CHECK(worst < 1.0);
}

TEST_CASE("Two-rate loop: exact discretisation at all hits of the fast loop") {
  const Model model = shipped("classic/two_rate_loop");
  Run run(model);
  run.finish();
  HeldMotor motor(1e-4);
  double speed_part = 0.0, current_part = 0.0, wanted = 0.0, worst = 0.0;
  for (int k = 0; k <= 4000; ++k) {
    const double t = k / 10000.0;
    worst = std::max({worst, weighted(run.logged("w", t), motor.w(), model.settings),
                      std::fabs(run.logged("i", t) - motor.i()) / (1e-10 + 1e-8 * 5.0)});
    if (k % 10 == 0) {
      const double e = 100.0 - motor.w();
      speed_part = std::clamp(speed_part + 2.5 * 1e-3 * e, -5.0, 5.0);
      wanted = std::clamp(0.1 * e + speed_part, -5.0, 5.0);
    }
    const double e = wanted - motor.i();
    current_part = std::clamp(current_part + 4000.0 * 1e-4 * e, -12.0, 12.0);
    motor.hold(std::clamp(2.0 * e + current_part, -12.0, 12.0), k >= 2000 ? 0.1 : 0.0);
  }

  // As for the sampled motor; the current is measured against its limit.
  CHECK(worst < 1.0);
}

TEST_CASE("Arc error loop: the published table of the nonlinear loop") {
  struct Row {
    const char* gain;
    double H_half, gamma_half, H_one, gamma_one;  // mm, rad at 0.5 s and 1 s
  };
  const Row table[] = {
      {"0.2", 32.559494, -0.12290514, -1.375409, -0.12993644},
      {"0.5", 34.961288, -0.09819518, 10.010901, -0.08913218},
      {"1.0954451", 38.394300, -0.06689908, 22.774404, -0.05371763},
      {"2.0", 41.574754, -0.04272108, 31.832285, -0.03454302},
  };
  for (const Row& row : table) {
    INFO(row.gain);
    const Model model = shipped("line_arc/arc_error_loop", {{"K_gamma", row.gain}});
    Run run(model);
    run.finish();
    // Half a unit in the last printed digit, and ten tolerances of the run.
    const double H = 0.5e-9 + 10.0 * (1e-10 + 1e-8 * 0.05), gamma = 0.5e-8 + 10.0 * (1e-10 + 1e-8 * 0.15);
    CHECK(std::fabs(run.logged("H", 0.5) - 1e-3 * row.H_half) < H);
    CHECK(std::fabs(run.logged("H", 1.0) - 1e-3 * row.H_one) < H);
    CHECK(std::fabs(run.logged("gamma", 0.5) - row.gamma_half) < gamma);
    CHECK(std::fabs(run.logged("gamma", 1.0) - row.gamma_one) < gamma);
  }
}

TEST_CASE("Diode rectifier: the current of the loop is that of Lambert's W") {
  Run run(shipped("classic/diode_rectifier"));
  run.finish();
  const std::vector<double> t = run.times(), u = run.column("u"), i = run.column("i");
  double worst = 0.0, greatest = 0.0;
  for (std::size_t k = 0; k < t.size(); ++k) {
    const double x = 10.0 * std::sin(314.0 * t[k]) - u[k];
    // W of exp(y), by Newton's method on w + ln w = y from above its root.
    const double y = std::log(1e-9 * 5.0 / 0.05) + (x + 1e-9 * 5.0) / 0.05;
    double w = y > 1.0 ? y : std::exp(y);
    for (int round = 0; round < 60; ++round) w *= (1.0 + y - std::log(w)) / (1.0 + w);
    worst = std::max(worst, std::fabs(i[k] - (0.05 / 5.0 * w - 1e-9)));
    greatest = std::max(greatest, i[k]);
  }
  CHECK(worst < 1e-12);   // A; the exponents, up to 20 and 200, carry some hundred roundings
  CHECK(greatest > 0.2);  // the first pulse fills the empty capacitor
}

TEST_CASE("Recorded command: the motor follows the rows of the file, and the noise has its deviation") {
  Model model = shipped("classic/recorded_command");
  model.settings.stop = 2.0;
  Run run(model);
  run.finish();
  const double rpm = M_PI / 30.0, tau = 0.1;
  // w = c(t) - s tau + (w0 - c0 + s tau) exp(-(t - t0)/tau) over a piece of slope s that begins with c0.
  const auto after = [&](double w0, double c0, double c1, double duration) {
    const double s = (c1 - c0) / duration;
    return c1 - s * tau + (w0 - c0 + s * tau) * std::exp(-duration / tau);
  };
  double w = after(0.0, 0.0, 300.0 * rpm, 0.5);
  w = after(w, 300.0 * rpm, 300.0 * rpm, 0.5);
  CHECK(weighted(run.logged("motor", 1.0), w, model.settings) < 500);
  w = after(w, -150.0 * rpm, -150.0 * rpm, 1.0);
  // Two hundred hits, each with a few steps within the tolerance.
  CHECK(weighted(run.logged("motor", 2.0), w, model.settings) < 500);
  double squares = 0.0;
  for (int k = 0; k < 200; ++k) {
    const double error = (run.logged("sensor", k / 100.0) - run.logged("motor", k / 100.0)) / 0.5;
    squares += error * error / 200.0;
  }
  // Four standard deviations of a mean of 200 squares.
  CHECK(std::fabs(squares - 1.0) < 4.0 * std::sqrt(2.0 / 200.0));
}
