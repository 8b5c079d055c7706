// Runs in lockstep against the same runs one by one.
#include "solvers/lane_simulator.h"

#include <cmath>

#include "solvers/parameters.h"
#include "tests/source_dir.h"
#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

namespace {

Model shipped(const std::string& path) { return load_model(source_dir() + "/models/" + path); }

/// Sets of one parameter each.
std::vector<ParameterSet> sweep(const Model& model, const std::string& name,
                                const std::vector<double>& values) {
  const int slot = settable_parameter(*model.plan, name);
  std::vector<ParameterSet> sets;
  for (const double value : values) sets.push_back({{slot, value}});
  return sets;
}

std::vector<LaneOutcome> run_lanes(const Model& model, const std::vector<ParameterSet>& sets,
                                   const LaneOptions& options = {}) {
  return run_in_lanes(model.plan, model.settings, sets, options);
}

std::vector<double> alone(const Model& model, const ParameterSet& set) {
  Simulator simulator(model.plan, model.settings, {false});
  for (const auto& [slot, value] : set) simulator.set_parameter(model.plan->slot_name(slot), value);
  simulator.run();
  return simulator.workspace().values;
}

/// Largest difference of a state from that of the same run alone, over 1 and the size of the state.
double difference(const Model& model, const LaneOutcome& outcome, const ParameterSet& set) {
  const std::vector<double> expected = alone(model, set);
  double largest = 0.0;
  for (int k = model.plan->layout.first_state; k < model.plan->layout.first_held; ++k) {
    const double scale = std::max(1.0, std::fabs(expected[k]));
    largest = std::max(largest, std::fabs(outcome.values[k] - expected[k]) / scale);
  }
  return largest;
}

/// At a tolerance of 1e-9 a step; both runs make a few hundred steps, so that they differ by less than 1e-6.
void check_against_single_runs(Model model, const std::vector<ParameterSet>& sets) {
  model.settings.rtol = 1e-9;
  model.settings.atol = 1e-11;
  const auto outcomes = run_lanes(model, sets);
  REQUIRE(outcomes.size() == sets.size());
  for (std::size_t k = 0; k < sets.size(); ++k) {
    INFO("run " << k);
    CHECK(outcomes[k].error.empty());
    CHECK_FALSE(outcomes[k].alone);
    CHECK(difference(model, outcomes[k], sets[k]) < 1e-6);
  }
}

/// Each lane switches its source at a time of its own.
constexpr const char* steps_at_times = R"(
flyball = 1
[parameters]
when = 0.3
[blocks]
r = { type = "Step", time = "when" }
x = { type = "TransferFcn", denominator = [0.2, 1.0] }
hold = { type = "ZeroOrderHold", sample_time = "0.25 s" }
sum = { type = "Integrator" }
[diagram]
wires = ["r -> x -> hold -> sum"]
log = ["x", "sum"]
[simulation]
stop = "1 s"
)";

/// x' = gain x^2 escapes at t = 1/gain.
constexpr const char* escapes = R"(
flyball = 1
[parameters]
gain = 0.1
[blocks]
x = { type = "Integrator", initial = 1.0 }
square = { type = "Product" }
g = { type = "Gain", gain = "gain" }
[diagram]
wires = ["x -> square.u1", "x -> square.u2", "square -> g -> x"]
log = ["x"]
[simulation]
stop = "2 s"
)";

}  // namespace

TEST_CASE("Equal runs in lockstep have the bits of one run") {
  // Not affine in the states, so that a single run calls its blocks as lanes do; and chaotic,
  // so that one bit shows.
  Model model = shipped("classic/lorenz.toml");
  model.settings.method = "dp5";
  for (const auto& outcome : run_lanes(model, std::vector<ParameterSet>(lane_count))) {
    CHECK(outcome.values == alone(model, {}));
  }
}

TEST_CASE("Lanes agree with single runs: relations that switch at different times") {
  const Model model = shipped("benchmarks/sweep.toml");
  std::vector<ParameterSet> sets;
  for (int i = 0; i < 7; ++i) {
    sets.push_back({{settable_parameter(*model.plan, "Kp"), 2.0 + 0.8 * i},
                    {settable_parameter(*model.plan, "wn"), 1.0 + 0.2 * i}});
  }
  check_against_single_runs(model, sets);
}

TEST_CASE("Lanes agree with single runs: crossings and handlers of each lane") {
  Model ball = shipped("classic/bouncing_ball.toml");
  ball.settings.stop = 1.5;  // before the bounces of the softest ball pile up
  check_against_single_runs(ball, sweep(ball, "ball.restitution", {0.8, 0.7, 0.75, 0.6, 0.65}));
  Model relay = shipped("benchmarks/relay.toml");
  relay.settings.stop = 20.0;
  check_against_single_runs(relay, sweep(relay, "relay.switch_on", {0.6, 0.62, 0.58, 0.7}));
}

TEST_CASE("Lanes agree with single runs: hits in common, alarms of each lane") {
  const Model model = read_model(steps_at_times);
  check_against_single_runs(model, sweep(model, "when", {0.3, 0.25, 0.5, 0.71, 2.0}));
}

TEST_CASE("Lanes agree with single runs: sampled controllers of two rates") {
  const Model model = shipped("classic/two_rate_loop.toml");
  check_against_single_runs(model, std::vector<ParameterSet>(3));
}

TEST_CASE("The rows of a lane are those of the single run") {
  const Model model = read_model(steps_at_times);
  const auto sets = sweep(model, "when", {0.3, 0.2, 0.5, 0.71});
  LaneOptions options;
  options.log.enabled = true;
  const auto outcomes = run_lanes(model, sets, options);
  for (std::size_t k = 0; k < sets.size(); ++k) {
    Simulator single(model.plan, model.settings);
    single.set_parameter("when", sets[k][0].second);
    single.run();
    REQUIRE(outcomes[k].log->rows() == single.log().rows());
    for (std::int64_t row = 0; row < single.log().rows(); ++row) {
      REQUIRE(outcomes[k].log->time(row) == single.log().time(row));
      // The error of both: a hundred steps at 1e-6.
      for (int c = 0; c < 2; ++c)
        REQUIRE(std::fabs(outcomes[k].log->value(row, c) - single.log().value(row, c)) < 1e-4);
    }
  }
}

TEST_CASE(
    "Lanes give the same bits on any number of threads, with any "
    "instruction set") {
  const Model model = shipped("benchmarks/sweep.toml");
  std::vector<double> gains;
  for (int i = 0; i < 4 * lane_count + 1; ++i) gains.push_back(1.0 + 0.5 * i);
  const auto sets = sweep(model, "Kp", gains);
  const auto expected = run_lanes(model, sets, {.isa = Isa::baseline});
  const auto threaded = run_lanes(model, sets, {.threads = 3, .isa = widest_isa()});
  for (std::size_t k = 0; k < sets.size(); ++k) CHECK(threaded[k].values == expected[k].values);
}

TEST_CASE("A lane that fails is run alone, and the others go on") {
  const Model model = read_model(escapes);
  const auto sets = sweep(model, "gain", {0.1, 1.0, 0.2, 0.3});
  const auto outcomes = run_lanes(model, sets);
  std::string reason;
  try {
    alone(model, sets[1]);
  } catch (const SimulationError& error) {
    reason = error.what();
  }
  REQUIRE_FALSE(reason.empty());
  CHECK(outcomes[1].error == reason);
  CHECK(outcomes[1].alone);
  for (const int k : {0, 2, 3}) {
    CHECK_FALSE(outcomes[k].alone);
    CHECK(difference(model, outcomes[k], sets[k]) < 1e-4);  // two hundred steps at 1e-6
  }
}

TEST_CASE("What cannot run in lockstep runs one by one") {
  Model model = shipped("benchmarks/sweep.toml");
  CHECK(refuses_lanes(*model.plan, model.settings).empty());
  model.settings.method = "bdf";
  CHECK(refuses_lanes(*model.plan, model.settings) ==
        "lanes run this diagram with the method dp5, not with bdf");
  const auto sets = sweep(model, "Kp", {3.0, 4.0});
  const auto outcomes = run_lanes(model, sets);
  for (std::size_t k = 0; k < sets.size(); ++k) {
    CHECK(outcomes[k].alone);
    CHECK(outcomes[k].values == alone(model, sets[k]));
  }
  const Model stateless = read_model(R"(
flyball = 1
[blocks]
clock = { type = "Clock" }
[diagram]
log = ["clock"]
[simulation]
stop = "1 s"
)");
  CHECK(refuses_lanes(*stateless.plan, stateless.settings).empty());
}

TEST_CASE("Blocks, loops and ends that are one run's own are named") {
  const auto reason = [](const std::string& blocks, const std::string& wires) {
    const Model model =
        read_model("flyball = 1\n[blocks]\nx = { type = \"Integrator\", initial = 1.0 }\n" + blocks +
                   "[diagram]\nwires = [" + wires + "]\nlog = [\"x\"]\n[simulation]\nstop = \"1 s\"\n");
    return refuses_lanes(*model.plan, model.settings);
  };
  CHECK(reason("s = { type = \"RepeatingSequence\" }\n", "\"s -> x\"") ==
        "s is a RepeatingSequence, which exists on numbers alone");
  CHECK(reason("end = { type = \"StopSimulation\" }\n", "\"x -> end\", \"x -> x\"").empty());
  CHECK(reason("e = { type = \"Sum\", signs = \"+-\" }\nk = { type = \"Gain\", gain = 0.5 }\n",
               "\"x -> e.u1\", \"e -> k -> e.u2\", \"k -> x\"") ==
        "an algebraic loop is solved for one run at a time");
  CHECK(reason("n = { type = \"RandomNumber\", sample_time = \"0.1 s\" }\n", "\"n -> x\"").empty());
}

TEST_CASE("Lanes agree with single runs: noise of each run") {
  const Model model = read_model(R"(
flyball = 1
[blocks]
n = { type = "RandomNumber", sample_time = "0.1 s" }
x = { type = "TransferFcn", denominator = [0.2, 1.0] }
[diagram]
wires = ["n -> x"]
log = ["x"]
[simulation]
stop = "1 s"
)");
  check_against_single_runs(model, sweep(model, "n.deviation", {1.0, 2.0, 0.5, 3.0}));
}

TEST_CASE("Where auto leaves dp5, no run goes in lockstep") {
  Model model = shipped("classic/van_der_pol_stiff.toml");
  model.settings.method = "auto";
  const auto outcomes = run_lanes(model, std::vector<ParameterSet>(2));
  for (const LaneOutcome& outcome : outcomes) {
    CHECK(outcome.alone);
    CHECK(outcome.values == alone(model, {}));
  }
}

TEST_CASE("A run that turns stiff leaves its group, and the others go on") {
  // x' = -rate (x - sin t): the first rates are slow, the third takes BDF where auto may choose.
  Model model = read_model(R"(
flyball = 1
[parameters]
rate = 1.0
[blocks]
wave = { type = "SineWave", frequency = 1.0 }
error = { type = "Sum", signs = "+-" }
gain = { type = "Gain", gain = "rate" }
x = { type = "Integrator" }
y = { type = "Integrator", initial = 1.0 }
square = { type = "Product" }
[diagram]
wires = ["wave -> error.u1", "x -> error.u2", "error -> gain -> x", "x -> square.u1", "x -> square.u2", "square -> y"]
log = ["x", "y"]
[simulation]
stop = "20 s"
)");
  const auto sets = sweep(model, "rate", {1.0, 2.0, 1e5, 0.5});
  const auto outcomes = run_lanes(model, sets);
  for (const int k : {0, 1, 3}) CHECK_FALSE(outcomes[k].alone);
  CHECK(outcomes[2].alone);
  CHECK(outcomes[2].values == alone(model, sets[2]));
  CHECK(outcomes[2].statistics.stepper.jacobians > 0);
  model.settings.method = "dp5";
  model.settings.stop = 0.1;  // stability allows 3e-5 s a step
  for (const LaneOutcome& outcome : run_lanes(model, sets)) CHECK_FALSE(outcome.alone);
}

TEST_CASE("Each lane has the random numbers of its seed") {
  const Model model = read_model(R"(
flyball = 1
[blocks]
n = { type = "RandomNumber", sample_time = "0.1 s" }
x = { type = "TransferFcn", denominator = [0.2, 1.0] }
[diagram]
wires = ["n -> x"]
log = ["n", "x"]
[simulation]
stop = "1 s"
)");
  LaneOptions options;
  options.log.enabled = true;
  LaneSimulator simulator(model.plan, model.settings, options);
  const std::vector<LaneInput> group{{{}, 7}, {{}, 8}, {{}, 7}, {}};
  const auto outcomes = simulator.run(group);
  const auto noise = [&](const Log& log) {
    std::vector<double> column;
    for (std::int64_t row = 0; row < log.rows(); ++row) column.push_back(log.value(row, 0));
    return column;
  };
  for (std::size_t k = 0; k < group.size(); ++k) {
    Model single = model;
    single.settings.seed = group[k].seed.value_or(model.settings.seed);
    Run run(single);
    run.finish();
    CHECK_FALSE(outcomes[k].alone);
    CHECK(noise(*outcomes[k].log) == run.column("n"));
    CHECK(noise(*simulator.run_alone(group[k]).log) == run.column("n"));
  }
  CHECK(noise(*outcomes[0].log) != noise(*outcomes[1].log));
}

TEST_CASE("The row at the end is that of a log") {
  const Model model = shipped("classic/two_rate_loop.toml");
  LaneOptions end, all;
  end.end_row = all.log.enabled = true;
  LaneSimulator with_end(model.plan, model.settings, end), with_all(model.plan, model.settings, all);
  const std::vector<LaneInput> group(lane_count);
  const auto last_row = [](const Log& log) {
    return std::vector<double>(log.data().end() - log.width() - 1, log.data().end());
  };
  const std::vector<double> expected = last_row(*with_all.run(group)[1].log);
  const Log row = *with_end.run(group)[1].log;
  CHECK(row.rows() == 1);
  CHECK(last_row(row) == expected);
  CHECK(with_end.run_alone({}).log->rows() == 1);
}

TEST_CASE("Work on lanes ends early where it is cancelled") {
  const Model model = shipped("benchmarks/sweep.toml");
  LaneOptions options;
  options.cancelled = [] { return true; };
  Model longer = model;
  longer.settings.stop = 1000.0;  // thousands of steps, of which each 256th looks
  LaneSimulator simulator(longer.plan, longer.settings, options);
  for (const LaneOutcome& outcome : simulator.run(std::vector<LaneInput>(3))) CHECK(outcome.cancelled);
  CHECK(simulator.run_alone({}).cancelled);
}

TEST_CASE("Parameters that are set together are checked together") {
  Model model = read_model(R"(
flyball = 1
[parameters]
low = 0.0
high = 1.0
width = { value = "high - low", range = [0.0, 10.0] }
[blocks]
x = { type = "Integrator" }
g = { type = "Gain", gain = "-width" }
[diagram]
wires = ["x -> g -> x"]
log = ["x"]
[simulation]
stop = "1 s"
)");
  const int low = settable_parameter(*model.plan, "low"), high = settable_parameter(*model.plan, "high");
  const std::vector<ParameterSet> sets{{{low, 5.0}, {high, 6.0}}};
  model.settings.method = "bdf";  // alone
  CHECK(run_lanes(model, sets)[0].error.empty());
  CHECK_THROWS_WITH(run_lanes(model, {{{low, 5.0}}}), "width is -4, outside its range [0, 10]");
}

TEST_CASE("Parameters of lanes are checked as those of a run") {
  const Model model = shipped("classic/bouncing_ball.toml");
  CHECK_THROWS_WITH(run_lanes(model, sweep(model, "ball.restitution", {0.5, 1.5})),
                    "ball.restitution is 1.5, outside its range [0, 1]");
  CHECK_THROWS_WITH(sweep(model, "ball.mass", {1.0}), "there is no parameter ball.mass");
}
