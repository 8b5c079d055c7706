#include <cmath>

#include "tests/systems/blocks.h"
#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

namespace {

/// While it lives, Spy blocks show their evaluations to `seen`.
class Watch {
 public:
  explicit Watch(std::function<void(double, double)> seen) { Spy::seen = std::move(seen); }
  ~Watch() { Spy::seen = nullptr; }
};

/// A sine through a limit, a step and a sampled sine, all of them into a Spy.
Model watched_diagram() {
  DiagramBuilder diagram;
  diagram.add("SineWave", "sine", {{"frequency", 3.0}});
  diagram.add("Saturation", "limit", {{"upper", 0.5}, {"lower", -0.5}});
  diagram.add("Step", "step", {{"time", 0.7}});
  diagram.add("ZeroOrderHold", "hold", {{"sample_time", Rational(1)}});
  diagram.add("Sum", "sum", {{"signs", std::string("+++")}});
  diagram.add<Spy>("spy");
  diagram.wire("sine.y", "limit.u");
  diagram.wire("sine.y", "hold.u");
  diagram.wire("limit.y", "sum.u1");
  diagram.wire("step.y", "sum.u2");
  diagram.wire("hold.y", "sum.u3");
  diagram.wire("sum.y", "spy.u");
  diagram.simulation.stop = 5.0;
  return diagram.build();
}

}  // namespace

TEST_CASE("S1: nothing but states moves during a step") {
  Run run(watched_diagram());
  run.advance();

  const Workspace<double>& now = run.simulator().workspace();
  const Layout& layout = run.plan().layout;
  const auto frozen = [&] {
    std::vector<double> numbers(now.bits.begin(), now.bits.end());
    numbers.insert(numbers.end(), now.values.begin() + 1, now.values.begin() + layout.first_state);
    numbers.insert(numbers.end(), now.values.begin() + layout.first_held,
                   now.values.begin() + layout.first_output);
    numbers.push_back(run["hold.y"]);
    return numbers;
  };
  std::vector<double> before;
  std::vector<bool> kept;
  const Watch watch([&](double, double) { kept.push_back(frozen() == before); });
  int changes = 0;
  for (bool more = true; more;) {
    before = frozen();
    kept.clear();
    more = run.advance();
    // An instant evaluates the rates once, after the step's own evaluations.
    for (std::size_t k = 0; k + 1 < kept.size(); ++k) REQUIRE(kept[k]);
    if (frozen() != before) ++changes;
  }
  // The step, 4 hits whose sine differs, and the edges of |sin 3t| = 0.5 in (0, 5): 9 or more.
  CHECK(changes >= 14);
}

TEST_CASE("S2: a step ends exactly on the next tick, alarm or stop time") {
  DiagramBuilder diagram;
  diagram.add("Step", "step", {{"time", 0.25}});
  diagram.add("ZeroOrderHold", "hold", {{"sample_time", *Rational::fraction(3, 10)}});
  diagram.add<Spy>("spy");
  diagram.wire("step.y", "hold.u");
  diagram.wire("hold.y", "spy.u");
  diagram.simulation.stop = 1.0;
  diagram.simulation.max_step = 1.0;
  Run run(diagram.build());
  double latest = 0.0;
  const Watch watch([&](double t, double) { latest = std::max(latest, t); });
  std::vector<double> ends{0.0};
  const double due[] = {0.25, 0.3, 0.6, 0.9, 1.0};
  for (bool more = true; more;) {
    const double next = *std::ranges::upper_bound(due, ends.back());
    more = run.advance();
    ends.push_back(run.time());
    CHECK(latest <= next);
  }
  for (const double t : due) CHECK(std::ranges::count(ends, t) == 1);
}

TEST_CASE("S3: no step is longer than max_step, by default a fiftieth of the run") {
  for (const std::string method : {"dp5", "adams", "bdf"}) {
    for (const std::optional<double> limit : {std::optional<double>(), std::optional(0.03)}) {
      INFO(method);
      DiagramBuilder diagram;
      diagram.add("Constant", "one");
      diagram.add("Integrator", "x");
      diagram.wire("one.y", "x.u");
      diagram.simulation.stop = 10.0;
      diagram.simulation.method = method;
      diagram.simulation.max_step = limit;
      Run run(diagram.build());
      const double longest = limit.value_or(0.2);
      CHECK(run.simulator().max_step() == longest);
      double before = 0.0, taken = 0.0;
      for (const double t : run.advance_times()) taken = std::max(taken, t - std::exchange(before, t));
      // The difference of two times near 10 is rounded to 2e-15.
      CHECK(taken <= longest + 2e-15);
      CHECK(taken > 0.9 * longest);
    }
  }
}

TEST_CASE("S4: a step ends on the far side of the first change of side in it") {
  for (const std::string method : {"auto", "dp5", "rk4", "heun", "euler", "adams", "bdf"}) {
    INFO(method);
    Run run(read_model(R"(
flyball = 1
[blocks]
one = { type = "Constant" }
x = { type = "Integrator" }
late = { type = "Saturation", upper = 5.0 }
early = { type = "Saturation", upper = 2.5 }
[diagram]
wires = ["one -> x -> late", "x -> early"]
[simulation]
stop = 8
solver = { method = ")" +
                       method + R"(", max_step = 8.0, step = 8.0 }
)"));
    double ends[2] = {};
    for (double& end : ends) {
      const long before = run.simulator().statistics().events;
      while (run.simulator().statistics().events == before) run.advance();
      end = run.time();
      CHECK(run[&end == ends ? "early.above" : "late.above"] > 0.0);
      CHECK(run.on("early.above"));
      CHECK(run.on("late.above") == (&end != ends));
    }
    // A root is bracketed to 4 units in the last place, and x = t is summed from a few steps; CVODE starts
    // with steps of 1e-9 of its own, so it sums more.
    CHECK(std::fabs(ends[0] - 2.5) < 1e-13);
    CHECK(std::fabs(ends[1] - 5.0) < 1e-13);
  }
}

TEST_CASE("S5: a root that is only touched does nothing; one that is crossed twice is found by short steps") {
  const auto parabola = [](const std::string& formula) {
    return R"(
flyball = 1
[blocks]
clock = { type = "Clock" }
height = { type = "Expression", inputs = ["t"], formula = ")" +
           formula + R"(" }
limit = { type = "Saturation", upper = 0.0, lower = -100.0 }
x = { type = "Integrator" }
[diagram]
wires = ["clock -> height -> limit -> x"]
[simulation]
stop = 2
solver = { max_step = 0.015 }
)";
  };
  Run touching(parabola("-(t - 1)^2"));
  touching.finish();
  CHECK(touching.simulator().statistics().events == 0);
  // Above zero from 0.99 to 1.01: longer than a step.
  Run crossing(parabola("1e-4 - (t - 1)^2"));
  crossing.finish();
  CHECK(crossing.simulator().statistics().events == 2);
}

TEST_CASE("S6: the step size goes on after an instant, and a multistep method restarts for changes only") {
  const auto model = [](const std::string& method, const std::string& source) {
    return read_model(R"(
flyball = 1
[blocks]
sine = { type = "SineWave" }
zero = { type = "Constant", value = 0.0 }
hold = { type = "ZeroOrderHold", sample_time = "1/10 s" }
a = { type = "Sum", signs = "+-" }
v = { type = "Integrator", initial = 1.0 }
x = { type = "Integrator" }
[diagram]
wires = [")" + source +
                      R"( -> hold -> a.u1", "x -> a.u2", "a -> v -> x"]
[simulation]
stop = 10
solver = { method = ")" +
                      method + R"(", rtol = 1e-4, atol = 1e-6 }
)");
  };
  Run quiet(model("adams", "zero"));
  CHECK(quiet.finish().simulator().statistics().stepper.restarts == 1);
  // sin(0) is what the hold shows before its first hit, too; the hit at the stop time restarts nothing.
  Run driven(model("adams", "sine"));
  CHECK(driven.finish().simulator().statistics().stepper.restarts == 1 + 99);
  // The tolerance would allow steps of some 0.3 s, so each interval is one step, but for the first, where the
  // size is still sought.
  Run single(model("dp5", "sine"));
  CHECK(single.finish().simulator().statistics().stepper.steps <= 105);
  CHECK(single.simulator().statistics().hits == 101);
}
