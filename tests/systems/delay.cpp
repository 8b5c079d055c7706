// TransportDelay in a run, against closed forms.
#include <cmath>
#include <cstring>

#include "solvers/sensitivities.h"
#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

namespace {

/// A formula of time, delayed by 0.7, and integrated, so that the method has something to step.
std::string delayed(const std::string& formula, const std::string& settings) {
  return R"toml(
flyball = 1
[blocks]
time = { type = "Clock" }
u = { type = "Expression", inputs = ["t"], formula = ")toml" +
         formula + R"toml(" }
late = { type = "TransportDelay", delay = 0.7 }
x = { type = "Integrator" }
[diagram]
wires = ["time -> u -> late -> x"]
log = ["late"]
[simulation]
stop = 4
log_interval = "1/128 s"
solver = { )toml" +
         settings + " }\n";
}

double worst_delayed_sine(double step) {
  Run run(delayed("sin(3*t)", "method = \"rk4\", step = " + std::to_string(step)));
  run.finish();
  double worst = 0.0;
  for (int k = 90; k <= 512; ++k) {
    const double t = k / 128.0;
    worst = std::max(worst, std::fabs(run.logged("late", t) - std::sin(3.0 * (t - 0.7))));
  }
  return worst;
}

/// x' = -x(t - 1) with x = 1 up to 0.
std::string loop(const std::string& solver) {
  return R"toml(
flyball = 1
[blocks]
x = { type = "Integrator", initial = 1.0 }
late = { type = "TransportDelay", delay = 1.0, initial = 1.0 }
back = { type = "Gain", gain = -1.0 }
[diagram]
wires = ["x -> late -> back -> x"]
log = ["x"]
[simulation]
stop = 5
log_interval = "1/4 s"
solver = { )toml" +
         solver + " }\n";
}

/// Its solution, by the method of steps: a polynomial of degree n + 1 between n and n + 1.
double solution(double t) {
  double sum = 1.0, factorial = 1.0;
  for (int k = 1; t > k - 1; ++k) {
    factorial *= k;
    sum += (k % 2 == 1 ? -1.0 : 1.0) * std::pow(t - (k - 1), k) / factorial;
  }
  return sum;
}

}  // namespace

TEST_CASE("S41: what a delay remembers has the fifth order in the step") {
  // Five points of a step h: at most 3e-5 h^5 times the fifth derivative of 243, and rounding.
  const double coarse = worst_delayed_sine(0.2), fine = worst_delayed_sine(0.1);
  CHECK(coarse < 3e-5 * std::pow(0.2, 5) * 243);
  const double order = std::log2(coarse / fine);
  // Among 128 points a second the worst stands close to the worst place of a step.
  CHECK((order > 4.8 && order < 5.2));
}

TEST_CASE("S41: a jump passes a delay as a jump, at its time") {
  Run run(R"toml(
flyball = 1
[blocks]
pulse = { type = "PulseGenerator", period = 1.0, duty = 0.25, delay = 0.1, amplitude = 2.0 }
late = { type = "TransportDelay", delay = 0.3, initial = -1.0 }
x = { type = "Integrator" }
[diagram]
wires = ["pulse -> late -> x"]
log = ["late"]
[simulation]
stop = 3
log_interval = 3
)toml");
  run.finish();
  const std::vector<double> t = run.times(), y = run.column("late");
  std::vector<double> jumps, values;
  for (std::size_t k = 1; k < t.size(); ++k) {
    if (y[k] == y[k - 1]) continue;
    REQUIRE(t[k] == t[k - 1]);
    jumps.push_back(t[k]);
    values.push_back(y[k]);
  }
  const std::vector<double> exact{0.3, 0.4, 0.65, 1.4, 1.65, 2.4, 2.65};
  REQUIRE(jumps.size() == exact.size());
  for (std::size_t k = 0; k < exact.size(); ++k) {
    // A sum of two times, each rounded.
    CHECK(std::fabs(jumps[k] - exact[k]) <= 2 * 0x1p-52);
    CHECK(values[k] == (k % 2 == 1 ? 2.0 : 0.0));
  }
  // -1 for 0.3 s, and three pulses of 2 for 0.25 s: pieces that are constant are exact up to rounding.
  CHECK(std::fabs(run["x.x"] - (-0.3 + 1.5)) <= 1e-14);
}

TEST_CASE("A delay in a loop is no algebraic loop: x' = -x(t - 1) by the method of steps") {
  for (const std::string method : {"dp5", "adams", "bdf"}) {
    INFO(method);
    Run run(loop("method = \"" + method + "\", rtol = 1e-9, atol = 1e-11"));
    run.finish();
    for (int k = 1; k <= 20; ++k) {
      const double t = k / 4.0;
      INFO("t = " << t);
      // The tolerance of each of the steps, of which multistep methods take hundreds.
      CHECK(std::fabs(run.logged("x", t) - solution(t)) <= (method == "dp5" ? 1e-9 : 1e-7));
    }
  }
}

TEST_CASE("A delay in a loop keeps the order of the method") {
  // x' = cos(t) + x(t - 1) - sin(t - 1), with the past sin(t): x = sin(t). Before 1 the past is a formula.
  const auto error_of = [](const char* step) {
    Run run(R"toml(
flyball = 1
[blocks]
time = { type = "Clock" }
x = { type = "Integrator" }
late = { type = "TransportDelay", delay = 1.0 }
rate = { type = "Expression", inputs = ["t", "late"], formula = "cos(t) + if(t < 1, 0, late - sin(t - 1))" }
[diagram]
wires = ["time -> rate.t", "x -> late -> rate.late", "rate -> x"]
[simulation]
stop = 6
solver = { method = "rk4", step = )toml" +
            std::string(step) + " }\n");
    run.finish();
    return std::fabs(run["x.x"] - std::sin(6.0));
  };
  const double order = std::log2(error_of("0.1") / error_of("0.05"));
  CHECK((order > 3.7 && order < 4.3));
}

TEST_CASE("A sampled signal is delayed as it is held") {
  Run run(R"toml(
flyball = 1
[blocks]
time = { type = "Clock" }
hold = { type = "ZeroOrderHold", sample_time = 0.25 }
late = { type = "TransportDelay", delay = 0.5, initial = -1.0 }
[diagram]
wires = ["time -> hold -> late"]
log = ["late"]
[simulation]
stop = 2
log_interval = "1/16 s"
)toml");
  run.finish();
  for (int k = 0; k <= 32; ++k) {
    const double t = k / 16.0;
    INFO("t = " << t);
    CHECK(run.logged("late", t) == (t < 0.5 ? -1.0 : std::floor((t - 0.5) * 4.0) / 4.0));
  }
}

TEST_CASE("Rows inside a long step look back to the short ones that lie a delay before it") {
  Run run(R"toml(
flyball = 1
[blocks]
sine = { type = "SineWave", frequency = 3.0 }
late = { type = "TransportDelay", delay = 0.5 }
x = { type = "Integrator" }
short1 = { type = "Step", time = 0.51 }
short2 = { type = "Step", time = 0.52 }
short3 = { type = "Step", time = 0.53 }
[diagram]
wires = ["sine -> late -> x"]
log = ["late"]
[simulation]
stop = 1.4
log_interval = "1/200 s"
solver = { method = "rk4", step = 0.4 }
)toml");
  run.finish();
  // The step from 1 to 1.4 recalls 0.5 to 0.9, of which 0.5 to 0.53 was remembered in steps of 0.01.
  for (int k = 201; k <= 206; ++k) {
    const double t = k / 200.0;
    INFO("t = " << t);
    CHECK(std::fabs(run.logged("late", t) - std::sin(3.0 * (t - 0.5))) <
          3e-5 * std::pow(0.01, 5) * 243 + 1e-15);
  }
}

TEST_CASE("A checkpoint holds the past: both runs go on with the same bits") {
  const Model model = read_model(loop("method = \"dp5\""));
  Simulator first(model.plan, model.settings);
  while (first.time() < 2.3) first.advance();
  Simulator second(model.plan, model.settings, first.workspace());
  first.run();
  second.run();
  const auto& a = first.workspace().values;
  const auto& b = second.workspace().values;
  CHECK(std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

TEST_CASE("A crossing of a delayed signal is located, and armed by its rate") {
  Run run(R"toml(
flyball = 1
[blocks]
sine = { type = "SineWave", frequency = "2*pi" }
late = { type = "TransportDelay", delay = 0.25 }
hits = { type = "HitCrossing", direction = "falling", offset = 0.5, width = 0.01 }
[diagram]
wires = ["sine -> late -> hits"]
[simulation]
stop = 3
solver = { max_step = 0.01 }
)toml");
  run.finish();
  // sin(2 pi (t - 1/4)) falls through 1/2 at 1/4 + 5/12 + n.
  CHECK(run["hits.count"] == 3.0);
  // Five points of a step of 0.01: 3e-5 (2 pi 0.01)^5 = 3e-11, over a slope of 5.4.
  CHECK(std::fabs(run["hits.end"] - (2.0 + 0.25 + 5.0 / 12.0 + 0.01)) < 1e-11);
}

TEST_CASE("Derivatives are refused where they would have to go through a delay") {
  const Model model = read_model(loop("method = \"dp5\""));
  CHECK_THROWS_WITH(Sensitivities(model.plan, model.settings, {{"back.gain"}, {"x"}, {1.0}}),
                    "derivatives do not go through late: a TransportDelay remembers numbers alone");
}
