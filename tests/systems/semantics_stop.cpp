#include <cmath>

#include "tests/systems/blocks.h"
#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

namespace {

using Kind = SimulationError::Kind;

std::string model(const std::string& blocks, const std::string& wires, const std::string& rest = "") {
  return "flyball = 1\n" + rest + "\n[blocks]\n" + blocks + "\n[diagram]\nwires = [" + wires + "]\n";
}

std::string not_finite(const std::string& text) {
  Run run(text);
  const SimulationError error = run.stop();
  CHECK(error.kind() == Kind::not_finite);
  return error.what();
}

}  // namespace

TEST_CASE("S26: the first bad output names block, port, time and inputs") {
  // 1/(1 - t) at the tick t = 1, in the middle of a chain that is bad behind it as well.
  CHECK(not_finite(model(R"toml(
clock = { type = "Clock" }
one = { type = "Constant" }
rest = { type = "Sum", signs = "+-" }
ratio = { type = "Product", signs = "*/" }
scaled = { type = "Gain", gain = 2.0 }
hold = { type = "ZeroOrderHold", sample_time = 1 }
)toml",
                         R"toml("one -> rest.u1, ratio.u1", "clock -> rest.u2", "rest -> ratio.u2",
"ratio -> scaled -> hold")toml")) == "ratio.y is inf at t = 1 s (u1 = 1, u2 = 0)");
}

TEST_CASE("S26: a bad output that only the log reads stops the run, too") {
  Run run(model(R"toml(
clock = { type = "Clock" }
root = { type = "Expression", formula = "sqrt(1 - u)" }
)toml",
                R"toml("clock -> root")toml", "simulation = { stop = 2, log_interval = \"1/4 s\" }"));
  const SimulationError error = run.stop();
  CHECK(error.what() == std::string("root.y is nan at t = 1.25 s (u = 1.25)"));
  CHECK(run.simulator().log().rows() == 5);
  CHECK(run.times().back() == 1.0);
}

TEST_CASE("S26: the first bad rate names block, state, time and inputs") {
  CHECK(not_finite(model(R"toml(
one = { type = "Constant" }
filter = { type = "TransferFcn", denominator = ["T", 1.0] }
)toml",
                         R"toml("one -> filter")toml", "[parameters]\nT = 0.0")) ==
        "the rate of filter.x1 is inf at t = 0 s (numerator[0] = 1, denominator[0] = 0, denominator[1] = 1, "
        "u = 1, x1 = 0)");
}

TEST_CASE("S26: a relation without a value names block, relation, time and inputs") {
  CHECK(not_finite(model(R"toml(
clock = { type = "Clock" }
big = { type = "Expression", formula = "if(sqrt(u - 1) > 3, 1, 0)" }
x = { type = "Integrator" }
)toml",
                         R"toml("clock -> big -> x")toml")) == "big.comparison1 is nan at t = 0 s (u = 0)");
}

TEST_CASE("S26: a bad sample names block, held value, time and inputs") {
  DiagramBuilder diagram;
  diagram.add("Clock", "clock");
  diagram.add("Gain", "back", {{"gain", -1.0}});
  diagram.add<SampledRoot>("root", {{"sample_time", *Rational::fraction(1, 2)}});
  diagram.wire("clock.y", "back.u");
  diagram.wire("back.y", "root.u");
  Run run(diagram.build());
  const SimulationError error = run.stop();
  CHECK(error.kind() == Kind::not_finite);
  CHECK(error.what() ==
        std::string(
            "the next value of root.root is nan at t = 0.5 s (sample_time = 0.5, u = -0.5, root = -0)"));
}

TEST_CASE("S26: a bad derivative in the Jacobian names both states") {
  // x' = sqrt(x) has the rate 0 at 0, where its slope is infinite.
  CHECK(not_finite(model(R"toml(
x = { type = "Integrator" }
root = { type = "Expression", formula = "sqrt(u)" }
)toml",
                         R"toml("x -> root -> x")toml", "simulation = { solver = { method = \"bdf\" } }"))
            .find("the derivative of the rate of x.x by x.x is inf at t = ") == 0);
}

TEST_CASE("S26: a derived parameter without a value is refused, in the file and later") {
  const std::string block = "x = { type = \"Constant\", value = \"b\" }";
  CHECK(refusal_of(model(block, "", "[parameters]\na = -1.0\nb = \"sqrt(a)\"")) ==
        "model.toml:4:6: error: expected a finite number, but the value is not a number\n");
  Run run(model(block, "", "[parameters]\na = 4.0\nb = \"sqrt(a)\""));
  CHECK_THROWS_WITH(run.simulator().set_parameter("a", -1.0), "b is not a number");
  run.simulator().set_parameter("a", 9.0);
  run.advance();
  CHECK(run["x.y"] == 3.0);
}

TEST_CASE("S26: an initial value that is not finite names its state") {
  DiagramBuilder diagram;
  diagram.add("Constant", "zero", {{"value", 0.0}});
  diagram.add("Integrator", "x", {{"initial", std::nan("")}});
  diagram.wire("zero.y", "x.u");
  Run run(diagram.build());
  const SimulationError error = run.stop();
  CHECK(error.kind() == Kind::not_finite);
  CHECK(error.what() == std::string("the initial value of x.x is nan"));
}

TEST_CASE("S26: with every method") {
  for (const std::string method : {"auto", "dp5", "rk4", "heun", "euler", "adams", "bdf"}) {
    INFO(method);
    Run run(model(R"toml(
one = { type = "Constant", value = -1.0 }
x = { type = "Integrator", initial = 1.0 }
root = { type = "Expression", formula = "sqrt(u)" }
y = { type = "Integrator" }
)toml",
                  R"toml("one -> x -> root -> y")toml",
                  "simulation = { solver = { method = \"" + method + "\" } }"));
    const SimulationError error = run.stop();
    CHECK(error.kind() == Kind::not_finite);
    CHECK(std::string(error.what()).find("root.y is nan at t = ") == 0);
    // The trial steps of a method reach at most one step beyond 1, where x passes zero.
    CHECK(error.time() >= 1.0);
    CHECK(error.time() <= 1.0 + run.simulator().max_step());
  }
}

TEST_CASE("S27: crossings that fire each other in one instant are chattering") {
  DiagramBuilder diagram;
  diagram.add<Restless>("restless");
  diagram.simulation.stop = 2.0;
  Run run(diagram.build());
  const SimulationError error = run.stop();
  CHECK(error.kind() == Kind::chattering);
  CHECK(std::fabs(error.time() - 1.0) < 1e-14);
  CHECK(std::string(error.what()).find("after 50 rounds these crossings still fire: restless.flip") !=
        std::string::npos);
}

TEST_CASE("S27: sliding is stopped as chattering, with the switch named first") {
  // x' = -sign(x) slides along 0 from t = 0.5 on; the light flickers along but moves nothing.
  const std::string light = R"toml(light = { type = "Switch", threshold = 0.0 }
)toml";
  for (const std::string method : {"dp5", "adams", "bdf"}) {
    INFO(method);
    Run run(model(light + R"toml(
plus = { type = "Constant", value = 1.0 }
minus = { type = "Constant", value = -1.0 }
x = { type = "Integrator", initial = 0.5 }
switch = { type = "Switch", threshold = 0.0 }
)toml",
                  R"toml("x -> switch.control, light.control", "minus -> switch.u1, light.u1",
"plus -> switch.u3, light.u3", "switch -> x")toml",
                  "simulation = { stop = 2, solver = { method = \"" + method + "\" } }"));
    const SimulationError error = run.stop();
    CHECK(error.kind() == Kind::chattering);
    CHECK(std::fabs(error.time() - 0.5) < 1e-6);
    INFO(error.what());
    CHECK(std::string(error.what()).find("by relation switch.exceeds, relation light.exceeds;") !=
          std::string::npos);
  }
}

TEST_CASE("S27: a relay without hysteresis slides, and is named before a relation that moves nothing") {
  Run run(model(R"toml(
light = { type = "Switch", threshold = 0.0 }
one = { type = "Constant" }
x = { type = "Integrator", initial = 0.5 }
error = { type = "Gain", gain = -1.0 }
relay = { type = "Relay", switch_on = 0.0, switch_off = 0.0, on = 1.0, off = -1.0 }
)toml",
                R"toml("x -> error -> relay -> x", "x -> light.control", "one -> light.u1, light.u3")toml",
                "simulation = { stop = 2 }"));
  const SimulationError error = run.stop();
  CHECK(error.kind() == Kind::chattering);
  INFO(error.what());
  CHECK(std::string(error.what())
            .find("by crossing relay.turns_on, crossing relay.turns_off, relation light.exceeds;") !=
        std::string::npos);
}

TEST_CASE("S27: events that pile up are stopped as chattering") {
  // Each bounce keeps half the speed: infinitely many until sqrt(2 h/g) (1 + 2 (r + r^2 + …)) = 3 sqrt(2
  // h/g).
  Run run(model("ball = { type = \"BouncingBall\", restitution = 0.5 }", "", "simulation = { stop = 5 }"));
  const SimulationError error = run.stop();
  CHECK(error.kind() == Kind::chattering);
  CHECK(std::fabs(error.time() - 3.0 * std::sqrt(2.0 / 9.81)) < 1e-9);
  CHECK(std::string(error.what()).find("by crossing ball.ground;") != std::string::npos);
}

TEST_CASE("S28: a step that vanishes names the states with the largest errors") {
  for (const std::string method : {"dp5", "adams", "bdf"}) {
    INFO(method);
    // x' = x^2 has a pole at t = 1; y and z are harmless.
    Run run(model(R"toml(
x = { type = "Integrator", initial = 1.0 }
square = { type = "Product", signs = "**" }
y = { type = "Integrator", initial = 1.0 }
back = { type = "Gain", gain = -1.0 }
)toml",
                  R"toml("x -> square.u1, square.u2", "square -> x", "y -> back -> y")toml",
                  "simulation = { stop = 2, solver = { method = \"" + method + "\" } }"));
    const SimulationError error = run.stop();
    INFO(error.what());
    CHECK(error.kind() == Kind::step_vanished);
    CHECK(std::fabs(error.time() - 1.0) < 1e-4);
    const std::string text = error.what();
    CHECK(text.find("the step vanished: ") == 0);
    CHECK(text.find("(x.x: error ") != std::string::npos);
    CHECK(text.find("times the tolerance; y.x: error ") != std::string::npos);
  }
}

TEST_CASE("S29: what was logged before an error is kept") {
  Run run(model(R"toml(
clock = { type = "Clock" }
back = { type = "Expression", formula = "sqrt(1 - u)" }
x = { type = "Integrator" }
)toml",
                R"toml("clock -> back -> x")toml",
                "simulation = { stop = 2, log_interval = \"1/8 s\", solver = { max_step = 0.125 } }"));
  run.stop();
  REQUIRE(run.simulator().log().rows() >= 8);
  for (const double t : {0.0, 0.5, 0.875}) {
    // The integral of sqrt(1 - t); the tolerance is 1e-6, and x <= 2/3.
    CHECK(std::fabs(run.logged("x", t) - 2.0 / 3.0 * (1.0 - std::pow(1.0 - t, 1.5))) < 1e-5);
  }
}

namespace {

// A ball that falls from 1 m for 0.4515 s.
constexpr auto falling = R"toml(
flyball = 1
[blocks]
ball = { type = "BouncingBall" }
guard = { type = "GUARD", threshold = 0.5, message = "half way down" }
[diagram]
wires = ["ball.height -> guard"]
log = ["ball.height", "ball.velocity"]
[simulation]
stop = "10 s"
log_interval = "50 ms"
solver = { method = "METHOD" }
)toml";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

// Of 9.81/2 t^2 = 1/2.
const double half_way = std::sqrt(1.0 / 9.81);

}  // namespace

TEST_CASE("S39: Assertion stops the run with its message, after the instant") {
  for (const std::string method : {"dp5", "bdf"}) {
    INFO(method);
    Run run(replaced(replaced(falling, "GUARD", "Assertion"), "METHOD", method));
    const SimulationError error = run.stop();
    CHECK(error.kind() == Kind::asserted);
    CHECK_THAT(error.what(), Catch::StartsWith("guard: half way down at t = 0.319"));
    // Some steps within rtol = 1e-6.
    CHECK(std::fabs(error.time() - half_way) < 1e-5);
    CHECK(run["guard.failed"] == 1.0);
    CHECK(run.times().back() == error.time());
  }
}

TEST_CASE("S39: StopSimulation ends the run as its stop time would") {
  std::string text = replaced(replaced(falling, "GUARD", "StopSimulation"), "METHOD", "dp5");
  text = replaced(text, "\"ball.height -> guard\"", "\"ball.height -> back -> guard\"");
  text = replaced(text, "[blocks]", "[blocks]\nback = { type = \"Gain\", gain = -1.0 }");
  Run run(replaced(text, "threshold = 0.5", "threshold = -0.5"));
  run.finish();
  CHECK(std::fabs(run.time() - half_way) < 1e-12);
  CHECK(run.simulator().end_reason() == "guard: half way down");
  // The asked times before, and the end.
  CHECK(run.times().size() == 8);
  CHECK(run.times().back() == run.time());
  CHECK_FALSE(run.advance());
}

TEST_CASE("S39: a divisor that passes zero is an error, and one that may jump is none") {
  const std::string wires = R"toml("one -> ratio.u1", "divisor -> ratio.u2")toml";
  const std::string one = "one = { type = \"Constant\" }\n";
  Run passing(
      model(one + "ratio = { type = \"Divide\" }\ndivisor = { type = \"Ramp\", slope = 0.7, initial = -1.0 }",
            wires));
  const SimulationError error = passing.stop();
  CHECK_THAT(error.what(), Catch::StartsWith("ratio: the divisor u2 passes zero at t = 1.428"));
  const std::string step = "divisor = { type = \"Step\", before = -1.0, after = 2.0 }";
  Run jumping(model(one + "ratio = { type = \"Divide\", divisor_jumps = true }\n" + step, wires));
  CHECK(jumping.finish()["ratio.y"] == 0.5);
  CHECK_THROWS_AS(Run(model(one + "ratio = { type = \"Divide\" }\n" + step, wires)).finish(),
                  SimulationError);
}

TEST_CASE(
    "S39: an assertion that fails at the start stops the run there, and before an end that is asked for") {
  Run run(model(R"toml(
zero = { type = "Constant", value = 0.0 }
one = { type = "Constant" }
halt = { type = "StopSimulation" }
check = { type = "Assertion" }
)toml",
                R"toml("zero -> check", "one -> halt")toml"));
  const SimulationError error = run.stop();
  CHECK(error.what() == std::string("check: the assertion failed at t = 0 s"));
}
