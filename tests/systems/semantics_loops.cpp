#include <cmath>

#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

namespace {

const std::string hint =
    "each of these needs the next one at the same time; an Integrator, a strictly proper TransferFcn or a "
    "UnitDelay anywhere in the chain breaks it";

const std::string breaks =
    "an Integrator, a strictly proper TransferFcn or a UnitDelay anywhere in the chain breaks it";

/// The diagnostics of a model that is not to have algebraic loops.
std::string refused(const std::string& text) {
  return refusal_of(text + "[simulation]\nalgebraic_loops = \"refuse\"\n");
}

/// A feedback loop r -> sum -> element -> sum.
std::string loop_through(const std::string& element, const std::string& wires) {
  return R"toml(flyball = 1
[blocks]
r = { type = "Constant" }
sum = { type = "Sum", signs = "+-" }
)toml" + element +
         "\n[diagram]\nwires = [\"r -> sum.u1\", " + wires + "]\nlog = [\"sum\"]\n";
}

std::string refusal(const std::string& position, const std::string& chain) {
  return "model.toml:" + position + ": error: algebraic loop: " + chain + "\nmodel.toml:" + position +
         ": note: " + hint + "\n";
}

}  // namespace

TEST_CASE("S30: a block whose output does not read an input breaks a loop") {
  const std::string elements[] = {
      R"(x = { type = "Integrator" })",
      R"(x = { type = "UnitDelay", sample_time = 1 })",
      R"(x = { type = "TransferFcn", numerator = [1.0], denominator = [1.0, 1.0] })",
      R"(x = { type = "StateSpace", A = [[-1.0]], B = [[1.0]], C = [[1.0]], D = [[0.0]] })",
      R"(x = { type = "StateSpace", A = [[-1.0]], B = [[1.0]], C = [[1.0]] })",
  };
  for (const std::string& element : elements) {
    INFO(element);
    Run run(loop_through(element, R"("sum -> x -> sum.u2")"));
    run.finish();
    CHECK(run.logged("sum", 0.0) == 1.0);
  }
}

TEST_CASE("S30: order is found element by element, so one vector may carry both ends of a chain") {
  // u goes through the first element of the Mux, and comes back through the second.
  Run run(R"toml(
flyball = 1
[blocks]
u = { type = "Constant", value = 3.0 }
join = { type = "Mux" }
split = { type = "Demux" }
twice = { type = "Gain", gain = 2.0 }
thrice = { type = "Gain", gain = 3.0 }
[diagram]
wires = ["u -> join.u1", "join -> split", "split.y1 -> twice -> join.u2", "split.y2 -> thrice"]
log = ["thrice"]
)toml");
  run.finish();
  CHECK(run.logged("thrice", 10.0) == 18.0);
}

TEST_CASE("S38: where loops are to be refused, the chain is told where its first block stands") {
  CHECK(refused(loop_through(R"(k = { type = "Gain", gain = 2.0 })", R"("sum -> k -> sum.u2")")) ==
        refusal("4:1", "sum.y -> k.u -> k.y -> sum.u2 -> sum.y"));
  CHECK(refused(loop_through(
            R"(k = { type = "TransferFcn", numerator = [1.0, 0.0], denominator = [1.0, 1.0] })",
            R"("sum -> k -> sum.u2")")) == refusal("4:1", "sum.y -> k.u -> k.y -> sum.u2 -> sum.y"));
  CHECK(refused(loop_through(
            R"(k = { type = "StateSpace", A = [[-1.0]], B = [[1.0]], C = [[1.0]], D = [[0.5]] })",
            R"("sum -> k -> sum.u2")")) == refusal("4:1", "sum.y -> k.u -> k.y -> sum.u2 -> sum.y"));
  CHECK(refused(
            loop_through(R"(k = { type = "ZeroOrderHold", sample_time = 1 })", R"("sum -> k -> sum.u2")")) ==
        refusal("4:1", "sum.y -> k.u -> k.y -> sum.u2 -> sum.y"));
}

TEST_CASE("S38: a loop through vectors is found behind them") {
  CHECK(refused(loop_through("join = { type = \"Mux\" }\nsplit = { type = \"Demux\" }",
                             R"("sum -> join.u1", "r -> join.u2", "join -> split", "split.y1 -> sum.u2")")) ==
        refusal("4:1", "sum.y -> sum.u2 -> sum.y"));
  CHECK(refusal_of(R"toml(flyball = 1
[blocks]
join = { type = "Mux" }
split = { type = "Demux" }
[diagram]
wires = ["join -> split", "split.y1 -> join.u1", "split.y2 -> join.u2"]
)toml")
            .find("model.toml:3:1: error: algebraic loop: join only passes its own output on") == 0);
}

TEST_CASE("S38: an output that uses a relation depends on what the relation reads") {
  CHECK(refused(loop_through(R"(pick = { type = "Switch", threshold = 0.5 })",
                             R"("sum -> pick.control", "r -> pick.u1, pick.u3", "pick -> sum.u2")")) ==
        refusal("4:1", "sum.y -> pick.control -> pick.exceeds -> pick.y -> sum.u2 -> sum.y"));
}

TEST_CASE("S38: a self-loop is the shortest chain") {
  CHECK(refused(R"toml(flyball = 1
[blocks]
  k = { type = "Gain" }
[diagram]
wires = ["k -> k"]
)toml") == refusal("3:3", "k.y -> k.u -> k.y"));
}

TEST_CASE("S31: the ports of a loop agree within 1e-10") {
  // z + z^3 = -x, x' = z from z = 1: the closed form is ln z + 3/2 z^2 + t = 3/2, and z falls to 0.
  Run run(R"toml(
flyball = 1
[blocks]
x = { type = "Integrator", initial = -2.0 }
z = { type = "Expression", inputs = ["x", "w"], formula = "-x - w^3" }
[diagram]
wires = ["x -> z.x", "z -> z.w", "z -> x"]
log = ["x", "z"]
[simulation]
stop = 5
solver = { method = "dp5", rtol = 1e-8, atol = 1e-10 }
)toml");
  run.finish();
  const std::vector<double> x = run.column("x"), z = run.column("z"), t = run.times();
  REQUIRE(t.size() > 1000);
  double residual = 0.0, error = 0.0;
  for (std::size_t k = 0; k < t.size(); ++k) {
    residual = std::max(residual, std::fabs(-x[k] - z[k] * z[k] * z[k] - z[k]));
    error = std::max(error, std::fabs(std::log(z[k]) + 1.5 * z[k] * z[k] + t[k] - 1.5));
  }
  CHECK(residual <= loop_tolerance);
  CHECK(error < 1e-6);  // rtol 1e-8 over some 50 steps; the logarithm divides by z, which falls to 0.03
}

TEST_CASE("S34: during a step the bits of a loop stand still, at an instant they and its values agree") {
  // y = sat(10 (t - y)): 10 t/11 until t = 1.1, where 10 (t - y) = 1; then 1.
  Run run(R"toml(
flyball = 1
[blocks]
t = { type = "Clock" }
error = { type = "Sum", signs = "+-" }
gain = { type = "Gain", gain = 10.0 }
limit = { type = "Saturation" }
[diagram]
wires = ["t -> error.u1", "error -> gain -> limit -> error.u2"]
log = ["limit"]
[simulation]
stop = 3
)toml");
  run.finish();
  const std::vector<double> y = run.column("limit"), t = run.times();
  double worst = 0.0;
  for (std::size_t k = 0; k < t.size(); ++k) {
    worst = std::max(worst, std::fabs(y[k] - (t[k] < 1.1 ? 10.0 * t[k] / 11.0 : 1.0)));
  }
  CHECK(worst < 1e-14);  // a few roundings: the loop is affine on either side
  CHECK(run.on("limit.above"));
  CHECK(run.simulator().statistics().events == 1);
}

TEST_CASE("S34: a loop that only bits close needs no solution, only bits that agree") {
  // y is 0.25 where t - y exceeds 0.5, else 0: off up to t = 0.5, on from there, and t - 0.25 < 0.5 at first.
  // Backwards: y is 0 where t - y exceeds 0.5, else 0.25, so that it switches over once, at t = 0.75.
  Run run(R"toml(
flyball = 1
[blocks]
t = { type = "Clock" }
sum = { type = "Sum", signs = "+-" }
zero = { type = "Constant", value = 0.0 }
quarter = { type = "Constant", value = 0.25 }
pick = { type = "Switch", threshold = 0.5 }
[diagram]
wires = ["t -> sum.u1", "zero -> pick.u1", "sum -> pick.control", "quarter -> pick.u3", "pick -> sum.u2"]
log = ["sum"]
[simulation]
stop = 1
)toml");
  run.finish();
  CHECK(run.logged("sum", 0.7) == 0.7 - 0.25);
  CHECK(run.logged("sum", 0.8) == 0.8);
  CHECK(run.simulator().statistics().events == 1);
}

TEST_CASE("S34: bits that no mode satisfies stop the run") {
  Run run(R"toml(
flyball = 1
[blocks]
one = { type = "Constant" }
minus = { type = "Constant", value = -1.0 }
pick = { type = "Switch" }
[diagram]
wires = ["minus -> pick.u1", "pick -> pick.control", "one -> pick.u3"]
)toml");
  const SimulationError error = run.stop();
  CHECK(error.kind() == SimulationError::Kind::algebraic_loop);
  CHECK(error.what() ==
        std::string("algebraic loop at t = 0 s: no consistent mode, pick.exceeds switches itself over: "
                    "pick.exceeds -> pick.y -> pick.control -> pick.exceeds; ") +
            breaks);
}

TEST_CASE("S35: a loop without a solution stops the run, and so does one that any value solves") {
  const auto message = [](const std::string& model) {
    const SimulationError error = Run(model).stop();
    CHECK(error.kind() == SimulationError::Kind::algebraic_loop);
    return std::string(error.what());
  };
  CHECK(message(R"toml(
flyball = 1
[blocks]
one = { type = "Constant" }
x = { type = "Sum" }
[diagram]
wires = ["one -> x.u1", "x -> x.u2"]
)toml") == "algebraic loop at t = 0 s: no solution, x.y needs to differ from itself: x.y -> x.u2 -> x.y; " +
               breaks);
  CHECK(message(R"toml(
flyball = 1
[blocks]
x = { type = "Gain" }
[diagram]
wires = ["x -> x"]
)toml") == "algebraic loop at t = 0 s: several solutions, x.y is one of many: x.y -> x.u -> x.y; " + breaks);
  CHECK(message(R"toml(
flyball = 1
[blocks]
x = { type = "Expression", formula = "u^2 + 1" }
[diagram]
wires = ["x -> x"]
)toml") == "algebraic loop at t = 0 s: no solution found from x.y = 0: x.y -> x.u -> x.y; " + breaks);
}

TEST_CASE("S35: where the start leaves open which solution is meant, the model says it") {
  // x = x^2 - 2 holds at 2 and at -1.
  const auto model = [](const std::string& guesses) {
    return R"toml(
flyball = 1
[blocks]
x = { type = "Expression", formula = "u^2 - 2" }
[diagram]
wires = ["x -> x"]
)toml" + guesses;
  };
  const SimulationError error = Run(model("")).stop();
  CHECK(error.kind() == SimulationError::Kind::algebraic_loop);
  const std::string text = error.what();
  INFO(text);
  CHECK(text.find("algebraic loop at t = 0 s: several solutions, x.y may be -1 or 2: give guesses = "
                  "[{ port = \"x.y\", value = … }] in [diagram]: x.y -> x.u -> x.y") == 0);
  CHECK(Run(model("guesses = [{ port = \"x\", value = 3.0 }]")).finish()["x.y"] ==
        Approx(2.0).epsilon(1e-15));
  CHECK(Run(model("guesses = [{ port = \"x\", value = -3.0 }]")).finish()["x.y"] ==
        Approx(-1.0).epsilon(1e-15));
  CHECK(refusal_of(R"toml(flyball = 1
[blocks]
c = { type = "Constant" }
[diagram]
guesses = [{ port = "c", value = 1.0 }]
)toml") == "model.toml:5:21: error: c.y is in no algebraic loop: there is nothing to guess\n");
}

TEST_CASE("S36: a loop through a sampled block is solved at its hits, and open between them") {
  // At t = k the held h = t - h gives h = k/2; until the next hit the sum is t - k/2.
  Run run(R"toml(
flyball = 1
[blocks]
t = { type = "Clock" }
sum = { type = "Sum", signs = "+-" }
hold = { type = "ZeroOrderHold", sample_time = 1 }
[diagram]
wires = ["t -> sum.u1", "sum -> hold -> sum.u2"]
log = ["sum", "hold"]
[simulation]
stop = 4
log_interval = "0.5 s"
)toml");
  run.finish();
  for (const double k : {0.0, 1.0, 2.0, 3.0}) {
    CHECK(run.logged("hold", k) == k / 2.0);
    CHECK(run.logged("sum", k) == k / 2.0);
    CHECK(run.logged("hold", k + 0.5) == k / 2.0);
    CHECK(run.logged("sum", k + 0.5) == k / 2.0 + 0.5);
  }
}
