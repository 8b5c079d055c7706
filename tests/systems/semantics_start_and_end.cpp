#include "tests/systems/blocks.h"
#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

TEST_CASE("S13: one instant at t = 0 sets initial values, hits, alarms and bits") {
  Run run(R"(
flyball = 1
[parameters]
x0 = 3.0
doubled = "2*x0"
[blocks]
x = { type = "Integrator", initial = "doubled" }
past = { type = "Step", time = -1.0 }
now = { type = "Step", time = 0.0 }
limit = { type = "Saturation", upper = 5.0 }
low = { type = "Saturation", lower = 7.0, upper = 9.0 }
pick = { type = "Switch", threshold = 4.0 }
hold = { type = "ZeroOrderHold", sample_time = 1 }
twice = { type = "UnitDelay", sample_time = 1, initial = "x0" }
[diagram]
wires = ["past -> x -> limit -> low", "x -> pick.control", "now -> pick.u1", "past -> pick.u3", "low -> hold",
         "limit -> twice"]
log = ["pick", "limit", "low", "hold", "twice"]
[simulation]
stop = 1
)");
  run.advance();
  CHECK(run["x.x"] >= 6.0);
  // Both alarms have rung, x is above the upper limit, and the limit is under the lower one.
  CHECK(run.logged("pick", 0.0) == 1.0);
  CHECK(run.logged("limit", 0.0) == 5.0);
  CHECK(run.logged("low", 0.0) == 7.0);
  CHECK(run.logged("hold", 0.0) == 7.0);
  CHECK(run.logged("twice", 0.0) == 3.0);
  CHECK(run.on("limit.above"));
  CHECK_FALSE(run.on("limit.below"));
  CHECK(run.on("low.below"));
  CHECK(run.on("pick.exceeds"));
  CHECK(run["twice.last"] == 5.0);
  CHECK(run.simulator().statistics().hits == 1);
  CHECK(run.simulator().statistics().alarms == 2);
}

TEST_CASE("S14: a crossing that begins strictly beyond its threshold is an edge at t = 0") {
  for (const std::string direction : {"rising", "falling", "either"}) {
    for (const double start : {-1.0, 0.0, 1.0}) {
      INFO(direction << " from " << start);
      DiagramBuilder diagram;
      diagram.add("Constant", "signal", {{"value", start}});
      diagram.add<EdgeCounter>("edges", {{"direction", direction}});
      diagram.wire("signal.y", "edges.u");
      diagram.simulation.stop = 1.0;
      Run run(diagram.build());
      run.finish();
      const bool beyond = (direction == "rising" && start > 0.0) || (direction == "falling" && start < 0.0);
      CHECK(run["edges.count"] == (beyond ? 1.0 : 0.0));
    }
  }
}

TEST_CASE("S15: before its first hit a sampled block shows 0 or its declared initial output") {
  Run run(R"(
flyball = 1
[blocks]
source = { type = "Constant", value = 3.0 }
hold = { type = "ZeroOrderHold", sample_time = 1, offset = "1/2 s" }
delay = { type = "UnitDelay", sample_time = 1, offset = "1/2 s", initial = 7.0 }
[diagram]
wires = ["source -> hold", "source -> delay"]
log = ["hold", "delay"]
[simulation]
stop = 2
log_interval = "1/4 s"
)",
          {true, EventRows::none});
  run.finish();
  CHECK(run.column("hold") == std::vector<double>{0, 0, 3, 3, 3, 3, 3, 3, 3});
  // At its first hit, at 0.5 s, it shows the initial value as well.
  CHECK(run.column("delay") == std::vector<double>{7, 7, 7, 7, 7, 7, 3, 3, 3});
  CHECK(run.simulator().statistics().hits == 2);
}

TEST_CASE("S16: ticks, alarms and events at the stop time still happen") {
  DiagramBuilder diagram;
  diagram.add("Step", "step", {{"time", 3.0}});
  diagram.add("Clock", "clock");
  // The root lies one unit in the last place before the stop time.
  diagram.add("Constant", "root", {{"value", std::nextafter(3.0, 0.0)}});
  diagram.add("Sum", "signal", {{"signs", std::string("+-")}});
  diagram.add<EdgeCounter>("edges");
  diagram.add<HitCounter>("hits", {{"sample_time", Rational(1)}});
  diagram.wire("clock.y", "signal.u1");
  diagram.wire("root.y", "signal.u2");
  diagram.wire("signal.y", "edges.u");
  diagram.log("step.y");
  diagram.simulation.stop = 3.0;
  Run run(diagram.build());
  run.finish();
  CHECK(run.time() == 3.0);
  CHECK(run["step.y"] == 1.0);
  CHECK(run["edges.count"] == 1.0);
  CHECK(run["hits.count"] == 4.0);
  CHECK(run["hits.late"] == 0.0);
  CHECK(run.logged("step.y", 3.0) == 1.0);
}
