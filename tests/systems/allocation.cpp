#include "tests/allocations.h"
#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

TEST_CASE("No allocation in a step, hit, alarm or event after the first of its kind") {
  for (const std::string method : {"auto", "dp5", "rk4", "heun", "euler", "adams", "bdf"}) {
    INFO(method);
    const Model model = read_model(R"toml(
flyball = 1
[blocks]
pulse = { type = "PulseGenerator", period = 0.3 }
sine = { type = "SineWave", frequency = 7.0 }
error = { type = "Sum", signs = "++-" }
sample = { type = "ZeroOrderHold", sample_time = "1/10 s" }
pid = { type = "DiscretePID", sample_time = "1/30 s", Kp = 2.0, Ki = 1.0 }
relay = { type = "Relay", switch_on = 0.2, switch_off = -0.2 }
drive = { type = "Sum" }
plant = { type = "TransferFcn", numerator = [2.0], denominator = [1.0, 0.4, 1.0] }
limit = { type = "Saturation", upper = 0.1, lower = -0.1 }
ball = { type = "BouncingBall", restitution = 1.0, initial_height = 0.1 }
[diagram]
wires = ["pulse -> error.u1", "sine -> error.u2", "plant -> error.u3", "error -> sample -> pid -> drive.u1",
         "error -> relay -> drive.u2", "drive -> plant -> limit"]
log = ["plant", "limit", "pid", "relay", "ball.height"]
[simulation]
stop = 10
solver = { method = ")toml" + method +
                                   "\" }\n");
    // Room for rows is taken in advance for asked times only: how many jumps there are, nobody knows.
    Simulator simulator(model.plan, model.settings, {true, EventRows::none});
    const auto done = [&] { return simulator.statistics(); };
    while (done().hits < 20 || done().events < 10 || done().alarms < 10) simulator.advance();
    const RunStatistics before = done();
    const long allocated = allocations();
    while (simulator.advance()) {
    }
    const long made = allocations() - allocated;
    CHECK(made == 0);
    CHECK(done().hits - before.hits > 200);
    CHECK(done().events - before.events > 50);
    CHECK(done().alarms - before.alarms > 30);
  }
}

TEST_CASE("No allocation where loops are solved, after the first solution") {
  for (const std::string method : {"dp5", "bdf"}) {
    INFO(method);
    const Model model = read_model(R"toml(
flyball = 1
[blocks]
drive = { type = "SineWave", frequency = 7.0 }
sum = { type = "Sum", signs = "+--" }
curve = { type = "Expression", inputs = ["u"], formula = "u + 0.3*u^3" }
limit = { type = "Saturation", upper = 0.15, lower = -0.15 }
plant = { type = "TransferFcn", numerator = [1.0], denominator = [1.0, 1.0] }
sample = { type = "ZeroOrderHold", sample_time = "1/10 s" }
half = { type = "Gain", gain = 0.5 }
[diagram]
wires = ["drive -> sum.u1", "sum -> curve -> limit -> sum.u2", "limit -> plant -> half", "sum -> sample -> sum.u3"]
log = ["plant", "limit"]
[simulation]
stop = 10
solver = { method = ")toml" + method +
                                   "\" }\n");
    REQUIRE(model.plan->loops.size() >= 2);
    Simulator simulator(model.plan, model.settings, {true, EventRows::none});
    const auto done = [&] { return simulator.statistics(); };
    while ((done().hits < 20 || done().events < 10) && simulator.advance()) {
    }
    const long allocated = allocations();
    while (simulator.advance()) {
    }
    const long made = allocations() - allocated;
    CHECK(made == 0);
    CHECK(done().events > 20);
  }
}
