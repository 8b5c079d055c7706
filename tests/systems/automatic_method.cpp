#include <cmath>

#include "tests/source_dir.h"
#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

namespace {

Run shipped_with(const std::string& name, const std::string& method) {
  Model model = load_model(source_dir() + "/models/" + name + ".toml");
  model.settings.method = method;
  return Run(model);
}

}  // namespace

TEST_CASE("auto stays with dp5 where nothing is stiff, to the bit") {
  for (const std::string name : {"classic/lorenz", "classic/bouncing_ball", "classic/relay_thermostat"}) {
    INFO(name);
    Run automatic = shipped_with(name, "auto"), explicit_steps = shipped_with(name, "dp5");
    automatic.finish();
    explicit_steps.finish();
    CHECK(automatic.simulator().method().method == "dp5");
    CHECK(automatic.simulator().method().reason == "the stiffness test found nothing");
    CHECK(automatic.simulator().log().data() == explicit_steps.simulator().log().data());
  }
}

TEST_CASE("auto turns to BDF on stiff models, and says when and why") {
  for (const auto& [name, fast] :
       {std::pair("classic/robertson", "B.x"), std::pair("classic/van_der_pol_stiff", "v.x")}) {
    INFO(name);
    Run run = shipped_with(name, "auto"), reference = shipped_with(name, "bdf");
    run.finish();
    reference.finish();
    const MethodReport report = run.simulator().method();
    INFO(report.reason);
    CHECK(report.method == "bdf");
    CHECK(report.reason.starts_with("dp5 until t = "));
    CHECK(report.reason.ends_with(std::string(" s, where stiffness had limited 15 steps, most of all ") +
                                  fast));
    // What comes before the switch is a few dozen steps; dp5 alone takes 34 589 and 1 161 263.
    CHECK(run.simulator().statistics().stepper.steps <
          2 * reference.simulator().statistics().stepper.steps + 100);
    const auto& settings = run.simulator().plan().diagram->simulation;
    for (const LogColumn& column : run.plan().columns) {
      const double value = run.column(column.name).back(), exact = reference.column(column.name).back();
      // Both lose some tens of tolerances on the way (the published values are tested elsewhere).
      CHECK(std::fabs(value - exact) < 200.0 * (settings.atol + settings.rtol * std::fabs(exact)));
    }
  }
}

TEST_CASE("auto takes exact steps where a linear plant is driven by held values and rows are at hits") {
  Run run = shipped_with("classic/sampled_dc_motor", "auto");
  run.finish();
  CHECK(run.simulator().method().method == "exact");
  CHECK(run.simulator().method().reason ==
        "between hits the rates are linear, and rows are asked for at hits");
  CHECK(run.simulator().statistics().stepper.steps == run.simulator().statistics().hits - 1);

  Model between = load_model(source_dir() + "/models/classic/sampled_dc_motor.toml");
  between.settings.method = "auto";
  between.settings.stop = 0.1;
  between.settings.log_interval = Rational::fraction(3, 2000);
  Run rows_inside(between);
  rows_inside.finish();
  CHECK(rows_inside.simulator().method().method == "dp5");
}

TEST_CASE("Without states auto needs no integrator") {
  const Model model = read_model(R"toml(
flyball = 1
[blocks]
sine = { type = "SineWave", frequency = 3.0 }
relay = { type = "Relay", switch_on = 0.5, switch_off = -0.5 }
hold = { type = "ZeroOrderHold", sample_time = "1/4 s" }
[diagram]
wires = ["sine -> relay", "sine -> hold"]
log = ["sine", "relay", "hold"]
[simulation]
stop = 10
)toml");
  Run run(model);
  run.finish();
  CHECK(run.simulator().method().method == "discrete");
  CHECK(run.simulator().method().reason == "there are no continuous states");
  CHECK(run.simulator().statistics().stepper.rate_evaluations == 0);
  const std::vector<double> t = run.times(), sine = run.column("sine"), relay = run.column("relay");
  int switches = 0;
  for (std::size_t k = 0; k < t.size(); ++k) {
    CHECK(sine[k] == std::sin(3.0 * t[k]));  // between instants, too: evaluated, not interpolated
    if (k == 0 || t[k] != t[k - 1] || relay[k] == relay[k - 1]) continue;
    // sin 3t passes 0.5 upwards at t = (pi/6 + 2 pi n)/3, then -0.5 downwards at (7 pi/6 + 2 pi n)/3.
    const double pi = std::acos(-1.0);
    CHECK(std::fabs(t[k] - (pi / 6.0 + pi * switches) / 3.0) < 1e-14);
    ++switches;
  }
  CHECK(switches == 10);
}

TEST_CASE("discrete is refused where there are states") {
  Model model = load_model(source_dir() + "/models/classic/lorenz.toml");
  model.settings.method = "discrete";
  CHECK_THROWS_AS(Simulator(model.plan, model.settings), std::invalid_argument);
}
