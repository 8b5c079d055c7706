#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

namespace {

const std::string hint =
    "each of these needs the next one at the same time; an Integrator, a strictly proper TransferFcn or a "
    "UnitDelay anywhere in the chain breaks it";

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

TEST_CASE("S31: an algebraic loop is refused with its chain, where its first block stands") {
  CHECK(refusal_of(loop_through(R"(k = { type = "Gain", gain = 2.0 })", R"("sum -> k -> sum.u2")")) ==
        refusal("4:1", "sum.y -> k.u -> k.y -> sum.u2 -> sum.y"));
  CHECK(refusal_of(loop_through(
            R"(k = { type = "TransferFcn", numerator = [1.0, 0.0], denominator = [1.0, 1.0] })",
            R"("sum -> k -> sum.u2")")) == refusal("4:1", "sum.y -> k.u -> k.y -> sum.u2 -> sum.y"));
  CHECK(refusal_of(loop_through(
            R"(k = { type = "StateSpace", A = [[-1.0]], B = [[1.0]], C = [[1.0]], D = [[0.5]] })",
            R"("sum -> k -> sum.u2")")) == refusal("4:1", "sum.y -> k.u -> k.y -> sum.u2 -> sum.y"));
  CHECK(refusal_of(
            loop_through(R"(k = { type = "ZeroOrderHold", sample_time = 1 })", R"("sum -> k -> sum.u2")")) ==
        refusal("4:1", "sum.y -> k.u -> k.y -> sum.u2 -> sum.y"));
}

TEST_CASE("S31: a loop through vectors is found behind them") {
  CHECK(refusal_of(
            loop_through("join = { type = \"Mux\" }\nsplit = { type = \"Demux\" }",
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

TEST_CASE("S31: an output that uses a relation depends on what the relation reads") {
  CHECK(refusal_of(loop_through(R"(pick = { type = "Switch", threshold = 0.5 })",
                                R"("sum -> pick.control", "r -> pick.u1, pick.u3", "pick -> sum.u2")")) ==
        refusal("4:1", "sum.y -> pick.control -> pick.exceeds -> pick.y -> sum.u2 -> sum.y"));
}

TEST_CASE("S31: a self-loop is the shortest chain") {
  CHECK(refusal_of(R"toml(flyball = 1
[blocks]
  k = { type = "Gain" }
[diagram]
wires = ["k -> k"]
)toml") == refusal("3:3", "k.y -> k.u -> k.y"));
}
