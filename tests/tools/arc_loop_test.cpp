#include "tools/arc_loop.h"

#include <cmath>
#include <string>

#include "studies/run.h"
#include "tests/catch.h"
#include "tests/source_dir.h"
#include "tools/model_file.h"

using namespace flyball;

namespace {

constexpr double mm = 1e-3;

/// The non-linear loop, integrated by a classical Runge-Kutta method with steps of 1 ms, and the closed form
/// of the linearised one; both rounded to the digits that stand here. H in mm.
struct Reference {
  const char* gain;
  double damping;
  double H_half, gamma_half, H_one, gamma_one;  // at 0.5 s and 1 s
  double linear_half, linear_one;
  double overshoot, linear_overshoot, settling, ise;
};

const Reference references[] = {{"0.2", 0.182574, 32.559494, -0.12290514, -1.375409, -0.12993644, 32.535337,
                                 -1.481006, 55.780, 55.801, 10.994, 2125.475},
                                {"0.5", 0.456435, 34.961288, -0.09819518, 10.010901, -0.08913218, 34.946999,
                                 9.965487, 19.945, 19.957, 4.561, 1375.803},
                                {"sqrt(1.2)", 1.0, 38.394300, -0.06689908, 22.774404, -0.05371763, 38.388475,
                                 22.761081, 0.0, 0.0, 3.196, 1712.347},
                                {"2.0", 1.825742, 41.574754, -0.04272108, 31.832285, -0.03454302, 41.572760,
                                 31.828404, 0.0, 0.0, 7.357, 2687.974}};

struct ArcRun {
  RunResult result;
  ArcLoop loop;
};

ArcRun run(const std::string& gain) {
  const ModelFile model =
      load_model(source_dir() + "/models/line_arc/arc_error_loop.toml", {{"K_gamma", gain}});
  INFO(listing(model.diagnostics));
  REQUIRE(model.plan);
  SimulationSettings settings = model.plan->diagram->simulation;
  settings.stop = arc_horizon;
  settings.log_interval = arc_log_interval;
  return {run_plan(model.plan, settings), arc_loop_of(*model.plan)};
}

}  // namespace

TEST_CASE("Arc loop: a run agrees with an independent integration of the non-linear loop") {
  for (const Reference& reference : references) {
    INFO("K_gamma = " << reference.gain);
    const ArcRun arc = run(reference.gain);
    REQUIRE(arc.result.status == RunStatus::finished);
    const Log& log = arc.result.log;
    // Half of the last digit of the reference, and ten times the solver's atol (1e-10) for its global error.
    const double distance = 0.5e-6 * mm + 1e-9, angle = 0.5e-8 + 1e-9;
    REQUIRE(log.time(100) == 0.5);
    CHECK(log.value(100, 0) == Approx(reference.H_half * mm).margin(distance));
    CHECK(log.value(100, 1) == Approx(reference.gamma_half).margin(angle));
    REQUIRE(log.time(200) == 1.0);
    CHECK(log.value(200, 0) == Approx(reference.H_one * mm).margin(distance));
    CHECK(log.value(200, 1) == Approx(reference.gamma_one).margin(angle));
  }
}

TEST_CASE("Arc loop: what is measured agrees with the same integration") {
  for (const Reference& reference : references) {
    INFO("K_gamma = " << reference.gain);
    const ArcMeasures measured = measure(run(reference.gain).result.log);
    // Half of the last digit, and a tenth for rows that are 5 ms apart: (5 ms omega)^2/8 = 1e-5 of the peak.
    CHECK(measured.overshoot == Approx(reference.overshoot).margin(0.55e-3 + 1e-5 * reference.overshoot));
    CHECK(measured.settling == Approx(reference.settling).margin(0.55e-3));
    CHECK(measured.ise / (mm * mm) == Approx(reference.ise).margin(0.55e-3));
  }
}

TEST_CASE("Arc loop: the closed forms are those of the linearised loop") {
  for (const Reference& reference : references) {
    INFO("K_gamma = " << reference.gain);
    const ArcLoop loop = run(reference.gain).loop;
    const ArcMeasures linear = linear_response(loop);
    // Half of the last digit that stands above.
    CHECK(linear_distance(loop, 0.5) == Approx(reference.linear_half * mm).margin(0.5e-6 * mm));
    CHECK(linear_distance(loop, 1.0) == Approx(reference.linear_one * mm).margin(0.5e-6 * mm));
    CHECK(linear.damping == Approx(reference.damping).margin(0.5e-6));
    CHECK(linear.overshoot == Approx(reference.linear_overshoot).margin(0.5e-3));
    // The settling time is a root: on one side of it the distance is outside of 2 %, on the other inside.
    const double edge = 0.02 * loop.H0;
    CHECK(std::fabs(linear_distance(loop, linear.settling)) == Approx(edge).epsilon(1e-9));
  }
}

TEST_CASE("Arc loop: the closed form of the ISE is the integral of the closed form of H") {
  for (const Reference& reference : references) {
    INFO("K_gamma = " << reference.gain);
    const ArcLoop loop = run(reference.gain).loop;
    double sum = 0.0;
    const double step = 1e-3;
    for (double t = 0.0; t < arc_horizon; t += step) {
      const double left = linear_distance(loop, t), right = linear_distance(loop, t + step);
      sum += 0.5 * step * (left * left + right * right);
    }
    // Trapezoids: (step omega)^2/12 = 3e-7 times a slope that is 0 at both ends.
    CHECK(linear_response(loop).ise == Approx(sum).epsilon(1e-6));
  }
}
