// Whatever happens to a model's text, reading it gives a diagram or an error with a position, and never
// crashes.
#include "models/diagram.h"
#include "tests/catch.h"
#include "tests/mutator.h"

using namespace flyball;

namespace {

const std::string valid = R"toml(flyball = 1
[model]
title = "A loop of many parts"
[parameters]
V = { value = "500 mm/s", doc = "speed", range = [0.0, 2.0] }
L = { value = 0.3, unit = "m" }
turn = "if(V > 0.2 m/s, -2*V/L, min(V/L, 1 1/s))"
Ts = "1/3 s"
[subsystems.Lag]
ports.inputs.u = { unit = "any", default = "2*V" }
ports.outputs.y = { elements = ["x", "v"] }
parameters = { T = { value = "1 s", range = ["1 ms", "1 h"] }, k = 1.0 }
subsystems.Rate = { ports = { inputs = { u = "any" }, outputs = { y = "any" } }, blocks = { g = { type = "Gain", gain = "k/T" } }, diagram = { wires = ["u -> g -> y"] } }
blocks = { error = { type = "Sum", signs = "+-" }, rate = { type = "Rate" }, x = { type = "Integrator" } }
diagram.wires = ["u -> error.u1", "error -> rate -> x -> error.u2", "x -> y.x", "rate -> y.v"]
[blocks]
lag = { type = "Lag", T = "Ts" }
step = { type = "Step", time = "10 ms", after = "V/L" }
error = { type = "Sum", signs = "+-" }
control = { type = "PID", Kp = "2*turn", Ki = 0.5, setpoint_weights = false }
plant = { type = "TransferFcn", numerator = [1.0], denominator = ["L", 0, 1.0] }
drive = { type = "DifferentialDrive" }
split = { type = "Mux", inputs = 3 }
square = { type = "Expression", formula = "u1^2 + abs(u2)*L^3/V", inputs = ["u1", "u2"] }
held = { type = "ZeroOrderHold", sample_time = "Ts" }
[diagram]
wires = [
  "step -> error.u1",
  "error -> control -> plant -> error.u2",
  "plant -> drive.right, drive.left, held",
  "drive.pose.x -> split.u1",
  "drive.pose.y -> split.u2, square.u1",
  "held -> split.u3, square.u2",
  "held -> lag",
]
log = ["plant", "drive.pose", "split.y.3", "lag.y", "lag.rate.g"]
[simulation]
stop = "10 s"
solver = { method = "dp5", rtol = 1e-8, max_step = "0.1 s" }
log_interval = "1/60 s"
)toml";

}  // namespace

TEST_CASE("the text that is mutated is a valid model") {
  Diagnostics diagnostics("m");
  const auto diagram = read_diagram(valid, diagnostics);
  for (const Diagnostic& diagnostic : diagnostics.sorted()) UNSCOPED_INFO(to_string(diagnostic));
  REQUIRE(diagram.has_value());
  CHECK(diagram->logged.size() == 8);
}

TEST_CASE("mutations of a model give a diagram or positioned errors") {
  int refused = 0;
  for (unsigned seed = 0; seed < 5000; ++seed) {
    test::Mutator mutator(seed);
    std::string text = mutator.mutate(valid);
    // Every other text gets a second mutation, so that mistakes meet.
    if (seed % 2 == 1 && !text.empty()) text = mutator.mutate(text);
    Diagnostics diagnostics("m");
    const auto diagram = read_diagram(text, diagnostics);
    CAPTURE(seed, text);
    REQUIRE(diagram.has_value() == !diagnostics.failed());
    for (const Diagnostic& diagnostic : diagnostics.sorted()) {
      REQUIRE(diagnostic.at.line >= 1);
      REQUIRE(diagnostic.at.column >= 1);
      REQUIRE_FALSE(diagnostic.message.empty());
    }
    if (!diagram) ++refused;
  }
  // Most mutations break something; else the mutator or the reader does not do its work.
  CHECK(refused > 2500);
}
