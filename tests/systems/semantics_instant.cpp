#include <cmath>

#include "tests/systems/blocks.h"
#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

namespace {

const std::string header = "flyball = 1\n";

std::vector<double> sequence(std::initializer_list<double> values) { return values; }

}  // namespace

TEST_CASE("S7: a sampled chain adds no hidden delay") {
  // x+ = 2 x + u + 1 under u = -2 x, the plant and the controller each sampled. A delay between them would
  // give 0 1 3 5 5 1 -7.
  Run run(header + R"(
[blocks]
x = { type = "UnitDelay", sample_time = 1 }
controller = { type = "Gain", gain = -2.0 }
u = { type = "ZeroOrderHold", sample_time = 1 }
plant = { type = "Expression", inputs = ["x", "u"], formula = "2*x + u + 1" }
[diagram]
wires = ["x -> controller -> u -> plant.u", "x -> plant.x", "plant -> x"]
log = ["x"]
[simulation]
stop = 6
log_interval = 1
)",
          {true, EventRows::none});
  run.finish();
  CHECK(run.column("x") == sequence({0, 1, 1, 1, 1, 1, 1}));
}

TEST_CASE("S8: sampled outputs are latched, and the commit does not change them") {
  Run run(header + R"(
[blocks]
clock = { type = "Clock" }
hold = { type = "ZeroOrderHold", sample_time = "1/2 s" }
delay = { type = "UnitDelay", sample_time = "1/2 s", initial = -1.0 }
[diagram]
wires = ["clock -> hold", "clock -> delay"]
log = ["hold", "delay"]
[simulation]
stop = 2
log_interval = "1/4 s"
)",
          {true, EventRows::none});
  run.finish();
  CHECK(run.column("hold") == sequence({0, 0, 0.5, 0.5, 1, 1, 1.5, 1.5, 2}));
  CHECK(run.column("delay") == sequence({-1, -1, 0, 0, 0.5, 0.5, 1, 1, 1.5}));
  // The commit of the last hit has stored the new input behind the output that the hit showed.
  CHECK(run["delay.last"] == 2.0);
  CHECK(run["delay.y"] == 1.5);
}

TEST_CASE("S9: a faster block reads the latched value of a slower one") {
  Run run(header + R"(
[blocks]
clock = { type = "Clock" }
slow = { type = "ZeroOrderHold", sample_time = "1/2 s" }
fast = { type = "ZeroOrderHold", sample_time = "1/8 s" }
live = { type = "ZeroOrderHold", sample_time = "1/8 s" }
[diagram]
wires = ["clock -> slow -> fast", "clock -> live"]
log = ["fast", "live"]
[simulation]
stop = 1
log_interval = "1/8 s"
)",
          {true, EventRows::none});
  run.finish();
  CHECK(run.column("fast") == sequence({0, 0, 0, 0, 0.5, 0.5, 0.5, 0.5, 1}));
  CHECK(run.column("live") == sequence({0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1}));
}

TEST_CASE("S10: handlers of an instant read the same sweep, whatever the others stage") {
  DiagramBuilder diagram;
  diagram.add("SineWave", "trigger");
  diagram.add<Exchange>("a", {{"initial", 1.0}});
  diagram.add<Exchange>("b", {{"initial", 2.0}});
  for (const std::string block : {"a", "b"}) {
    diagram.wire("trigger.y", block + ".trigger");
    diagram.wire(block == "a" ? "b.y" : "a.y", block + ".other");
  }
  diagram.simulation.stop = 10.0;
  Run run(diagram.build());
  // The sine rises through 0 just after 0 and at 2 pi.
  while (run.simulator().statistics().events < 2) run.advance();
  CHECK(run["a.value"] == 2.0);
  CHECK(run["b.value"] == 1.0);
  run.finish();
  CHECK(run.simulator().statistics().events == 4);
  CHECK(run["a.value"] == 1.0);
  CHECK(run["b.value"] == 2.0);
}

TEST_CASE(
    "S11: handlers of one block run on_sample, on_time, then crossings, each after what the last staged") {
  DiagramBuilder diagram;
  diagram.add<SampledSequence>("sampled", {{"sample_time", Rational(1)}, {"at", 2.0}});
  // Declared third, fourth, alarm; the roots lie one unit in the last place before the alarm.
  diagram.add<EventSequence>("events", {{"at", 1.0}, {"root", std::nextafter(1.0, 0.0)}});
  diagram.simulation.stop = 2.5;
  Run run(diagram.build());
  run.finish();
  CHECK(run["sampled.order"] == 1112.0);
  CHECK(run["events.order"] == 234.0);
}

TEST_CASE("S12: ticks, alarms and roots at one time are one instant") {
  DiagramBuilder diagram;
  // 0.1 + 0.2 is one unit above the tick 3/10.
  diagram.add("Step", "step", {{"time", 0.1 + 0.2}});
  diagram.add("Clock", "clock");
  diagram.add("Constant", "root", {{"value", std::nextafter(0.6, 0.0)}});
  diagram.add("Sum", "signal", {{"signs", std::string("+-")}});
  diagram.add<EdgeCounter>("edges");
  diagram.add<HitCounter>("hits",
                          {{"sample_time", *Rational::fraction(3, 10)}, {"hits_per_second", 1.0 / 0.3}});
  diagram.wire("clock.y", "signal.u1");
  diagram.wire("root.y", "signal.u2");
  diagram.wire("signal.y", "edges.u");
  diagram.simulation.stop = 0.75;
  Run run(diagram.build());
  const std::vector<double> ends = run.advance_times();
  for (const double tick : {0.3, 0.6}) {
    const auto near = [&](double t) { return std::fabs(t - tick) < 1e-14; };
    CHECK(std::ranges::count_if(ends, near) == 1);
    CHECK(std::ranges::count(ends, tick) == 1);
  }
  CHECK(run["step.y"] == 1.0);
  CHECK(run["edges.count"] == 1.0);
  CHECK(run["hits.count"] == 3.0);
}

TEST_CASE("S12: an alarm on a tick comes after the hits of the tick") {
  // All of an instant read one sweep, so the hit at 1 s still sees the value before the step.
  Run run(header + R"(
[blocks]
step = { type = "Step", time = 1.0 }
hold = { type = "ZeroOrderHold", sample_time = "1/2 s" }
[diagram]
wires = ["step -> hold"]
log = ["step", "hold"]
[simulation]
stop = 2
log_interval = "1/2 s"
)",
          {true, EventRows::none});
  run.finish();
  CHECK(run.column("step") == sequence({0, 0, 1, 1, 1}));
  CHECK(run.column("hold") == sequence({0, 0, 0, 1, 1}));
}

TEST_CASE("S12: a signal that is exactly zero on a tick crosses right after it") {
  DiagramBuilder diagram;
  diagram.add("Clock", "clock");
  diagram.add("Constant", "one");
  diagram.add("Sum", "signal", {{"signs", std::string("+-")}});
  diagram.add<EdgeCounter>("edges");
  diagram.add("ZeroOrderHold", "hold", {{"sample_time", Rational(1)}});
  diagram.wire("clock.y", "signal.u1");
  diagram.wire("one.y", "signal.u2");
  diagram.wire("signal.y", "edges.u");
  diagram.wire("edges.y", "hold.u");
  diagram.simulation.stop = 2.5;
  Run run(diagram.build());
  while (run.time() < 1.0) run.advance();
  CHECK(run.time() == 1.0);
  CHECK(run["edges.count"] == 0.0);
  run.advance();
  // The bracket of a root is 4 units in the last place.
  CHECK(run.time() > 1.0);
  CHECK(run.time() < 1.0 + 1e-14);
  CHECK(run["edges.count"] == 1.0);
  CHECK(run["hold.y"] == 0.0);
  run.finish();
  CHECK(run["edges.count"] == 1.0);
  CHECK(run["hold.y"] == 1.0);
}
