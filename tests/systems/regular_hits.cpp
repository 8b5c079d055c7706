// Hits at which nothing but sampling happens take a shorter way (solvers/regular_hits.h). `advance` never
// takes it, `run` does: all that a run gives must be the same, bit for bit.
#include <cstring>

#include "solvers/profile.h"
#include "tests/source_dir.h"
#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

namespace {

struct Outcome {
  std::vector<double> rows, values;
  std::vector<unsigned char> bits;
  RunStatistics statistics;
  std::string error;
};

template <class Finish>
Outcome outcome(const Model& model, LogOptions log, Finish&& finish) {
  Simulator simulator(model.plan, model.settings, log);
  Outcome result;
  try {
    finish(simulator);
  } catch (const SimulationError& error) {
    result.error = error.what();
  }
  result.rows = simulator.log().data();
  result.values = simulator.workspace().values;
  result.bits = simulator.workspace().bits;
  result.statistics = simulator.statistics();
  return result;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return false;
  return a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

/// Compares a whole run with one that is advanced step by step. Returns how many hits were taken the short
/// way.
long compare(const Model& model, LogOptions log = {}) {
  const Outcome fast = outcome(model, log, [](Simulator& s) { s.run(); });
  const Outcome plain = outcome(model, log, [](Simulator& s) {
    while (s.advance()) {
    }
  });
  CHECK(fast.error == plain.error);
  CHECK(same_bits(fast.rows, plain.rows));
  CHECK(same_bits(fast.values, plain.values));
  CHECK(fast.bits == plain.bits);
  CHECK(fast.statistics.hits == plain.statistics.hits);
  CHECK(fast.statistics.alarms == plain.statistics.alarms);
  CHECK(fast.statistics.events == plain.statistics.events);
  CHECK(fast.statistics.stepper.steps == plain.statistics.stepper.steps);
  CHECK(fast.statistics.stepper.restarts == plain.statistics.stepper.restarts);
  CHECK(plain.statistics.regular_hits == 0);
  return fast.statistics.regular_hits;
}

/// A plant of two states under a sampled controller, with more blocks, wires and logged signals.
Model loop(const std::string& blocks = "", const std::string& wires = "", const std::string& log = "",
           const std::string& simulation = "log_interval = \"10 ms\"") {
  return read_model(R"toml(
flyball = 1
[blocks]
wanted = { type = "Constant", value = 1.0 }
error = { type = "Sum", signs = "+-" }
pid = { type = "DiscretePID", sample_time = "10 ms", Kp = 2.0, Ki = 1.0, lower = -1.5, upper = 1.5 }
drive = { type = "Gain", gain = 1.5 }
plant = { type = "TransferFcn", numerator = [2.0], denominator = [1.0, 0.4, 1.0] }
unread = { type = "Gain", gain = 3.0 }
)toml" + blocks + R"toml(
[diagram]
wires = ["wanted -> error.u1", "plant -> error.u2", "error -> pid -> drive -> plant -> unread")toml" +
                    wires + "]\nlog = [\"plant\"" + log + R"toml(]
[simulation]
stop = 5
solver = { method = "exact" }
)toml" + simulation +
                    "\n");
}

constexpr long all_but_few = 480;  // of 500 hits

}  // namespace

TEST_CASE("A sampled motor takes nearly all of its hits the short way") {
  const Model model = load_model(source_dir() + "/models/classic/sampled_dc_motor.toml");
  for (const EventRows rows : {EventRows::both, EventRows::after, EventRows::none}) {
    // 10 001 hits: not the first, the one with the load, the last, and one in a thousand for progress.
    CHECK(compare(model, {true, rows}) >= 9980);
  }
  CHECK(compare(model, {false}) >= 9980);
}

TEST_CASE("Every shipped model with hits gives the same bits both ways") {
  int models = 0;
  for (const std::string& file : model_files()) {
    Model model = load_model(file);
    if (model.plan->hit_rates.empty()) continue;
    INFO(file);
    ++models;
    for (const std::string method : {"auto", "exact"}) {
      model.settings.method = method;
      compare(model);
    }
  }
  CHECK(models >= 2);
}

TEST_CASE("Regular hits log what jumps on both sides, and what is computed from it") {
  // drive and scaled are computed at hits only because they are logged.
  const Model model = loop("scaled = { type = \"Gain\", gain = 0.1 }", ", \"plant -> scaled\"",
                           ", \"pid\", \"drive\", \"scaled\", \"error\"");
  for (const EventRows rows : {EventRows::both, EventRows::after, EventRows::none})
    CHECK(compare(model, {true, rows}) >= all_but_few);
}

TEST_CASE("Regular hits of several rates, offsets, and what unsampled blocks make between them") {
  const Model model = loop(
      R"toml(
slow = { type = "ZeroOrderHold", sample_time = "35 ms", offset = "5 ms" }
old = { type = "UnitDelay", sample_time = "20 ms", initial = 0.3 }
curve = { type = "TrigonometricFunction", function = "sin" }
second = { type = "TransferFcn", numerator = [1.0], denominator = [0.2, 1.0] }
limit = { type = "Saturation", lower = -0.2, upper = 0.2 }
count = { type = "CounterLimited", sample_time = "30 ms", upper = 4.0 }
)toml",
      ", \"plant -> slow -> limit -> second -> old -> curve\"",
      ", \"second\", \"curve\", \"limit\", \"count\"");
  CHECK(compare(model, {true, EventRows::both}) > 500);
}

TEST_CASE("Regular hits without states, with noise, tables and memories of their own") {
  const Model model = read_model(R"toml(
flyball = 1
[blocks]
noise = { type = "RandomNumber", sample_time = "1/10 s" }
uniform = { type = "UniformRandomNumber", sample_time = "1/30 s" }
filter = { type = "DiscreteTransferFcn", sample_time = "1/30 s", numerator = [0.5], denominator = [1.0, -0.5] }
table = { type = "LookupTable1D", breakpoints = [-1.0, 0.0, 2.0], table = [0.0, 1.0, -1.0] }
sum = { type = "Sum" }
memory = { type = "DiscreteTimeIntegrator", sample_time = "1/10 s", upper = 1.0, lower = -1.0 }
square = { type = "Product" }
[diagram]
wires = ["noise -> sum.u1", "uniform -> filter -> sum.u2", "sum -> memory -> square.u1", "memory -> square.u2",
         "filter -> table"]
log = ["sum", "memory", "square", "table"]
[simulation]
stop = 20
log_interval = "1/5 s"
)toml");
  compare(model);
}

TEST_CASE("What is irregular takes the long way: alarms, rows inside steps, steps before a hit") {
  SECTION("an alarm at a hit, and one between two") {
    for (const char* time : {"2.0", "2.003"}) {
      INFO(time);
      const Model model = loop(
          std::string("load = { type = \"Step\", time = ") + time + " }\nlag = { type = \"TransferFcn\" }",
          ", \"load -> lag\"", ", \"lag\"");
      const long taken = compare(model);
      CHECK(taken >= all_but_few);
      CHECK(taken < 499);
    }
  }
  SECTION("an alarm within rounding of a hit") {
    const Model model =
        loop("load = { type = \"Step\", time = 2.0000000000000013 }\nlag = { type = \"TransferFcn\" }",
             ", \"load -> lag\"", ", \"lag\"");
    CHECK(compare(model) >= all_but_few);
  }
  SECTION("rows inside steps") {
    CHECK(compare(loop("", "", "", "log_interval = \"2 ms\"")) == 0);
    const long some = compare(loop("", "", "", "log_interval = \"25 ms\""));
    CHECK(some > 200);
    CHECK(some < 400);
  }
  SECTION("steps shorter than the period") {
    Model model = loop();
    model.settings.max_step = 0.004;
    CHECK(compare(model) >= all_but_few);  // from the last step before each
  }
}

TEST_CASE("What may switch between hits, end the run or remember takes the long way") {
  const auto taken = [](const char* blocks, const char* wires) { return compare(loop(blocks, wires)); };
  CHECK(taken("limit = { type = \"Saturation\", upper = 0.8 }", ", \"plant -> limit\"") == 0);
  CHECK(taken("seen = { type = \"HitCrossing\", offset = 0.5 }", ", \"plant -> seen\"") == 0);
  CHECK(taken("stop = { type = \"StopSimulation\", threshold = 0.9 }", ", \"plant -> stop\"") == 0);
  CHECK(taken("check = { type = \"Assertion\", threshold = -5.0 }", ", \"plant -> check\"") == 0);
  CHECK(taken("late = { type = \"TransportDelay\", delay = 0.1 }", ", \"plant -> late\"") == 0);
}

TEST_CASE("A bit that scales a rate may change at a regular hit") {
  // The switch passes the state or its double, by a sampled signal: the matrix of the rates changes with it.
  const Model model = loop(
      R"toml(
count = { type = "CounterLimited", sample_time = "70 ms", upper = 3.0 }
twice = { type = "Gain", gain = 2.0 }
choice = { type = "Switch", threshold = 1.5 }
lag = { type = "TransferFcn", numerator = [1.0], denominator = [0.3, 1.0] }
)toml",
      ", \"plant -> twice -> choice.u1\", \"count -> choice.control\", \"plant -> choice.u3\", \"choice -> "
      "lag\"",
      ", \"lag\"");
  CHECK(compare(model) >= all_but_few);
}

TEST_CASE("Values that are not finite are named at a regular hit as at any other") {
  SECTION("of a sampled block") {
    const Model model =
        loop("grow = { type = \"DiscreteTimeIntegrator\", sample_time = \"10 ms\", gain = 1e308 }",
             ", \"wanted -> grow\"");
    const Outcome end = outcome(model, {}, [](Simulator& s) { s.run(); });
    CHECK_FALSE(end.error.empty());
    CHECK(end.statistics.regular_hits > 50);
    compare(model);
  }
  SECTION("of a block that is not computed at regular hits") {
    // 1e308 times a state that passes 1.797 on its way to 2: only the rate of `lost` reads it.
    const Model model = loop(R"toml(
twice = { type = "Gain", gain = 2.0 }
rise = { type = "TransferFcn", numerator = [1.0], denominator = [1.0, 1.0] }
huge = { type = "Gain", gain = 1e308 }
small = { type = "Gain", gain = 1e-308 }
lost = { type = "Integrator" }
)toml",
                             ", \"wanted -> twice -> rise -> huge -> small -> lost\"");
    const Outcome end = outcome(model, {}, [](Simulator& s) { s.run(); });
    INFO(end.error);
    CHECK(end.error.starts_with("huge.y is inf at t = "));
    compare(model);
  }
  SECTION("of a state") {
    const Model model = loop(R"toml(
run_away = { type = "TransferFcn", numerator = [1.0], denominator = [1.0, -200.0] }
)toml",
                             ", \"wanted -> run_away\"");
    compare(model);
  }
}

TEST_CASE("Regular hits pause for progress, with a workspace that goes on with the same bits") {
  const Model model = load_model(source_dir() + "/models/classic/sampled_dc_motor.toml");
  Simulator whole(model.plan, model.settings), first(model.plan, model.settings);
  whole.run();
  first.run([](double done) { return done < 0.3; });
  REQUIRE(first.time() > 2.9);
  REQUIRE(first.time() < 3.5);
  const std::int64_t rows = first.log().rows();
  Simulator second(model.plan, model.settings, first.workspace());
  second.run();
  CHECK(second.statistics().regular_hits > 6000);
  CHECK(rows + second.log().rows() == whole.log().rows());
  for (std::int64_t k = 0; k < second.log().rows(); ++k) {
    // The periods of the ticks differ in their last places, and each run takes the first one that it meets:
    // 1e-16 s of 1 ms, in a loop that forgets within 10 ms.
    CHECK(second.log().value(k, 0) == Approx(whole.log().value(rows + k, 0)).epsilon(1e-12));
  }
}

TEST_CASE("A profile sees every hit") {
  const Model model = load_model(source_dir() + "/models/classic/sampled_dc_motor.toml");
  Simulator plain(model.plan, model.settings), seen(model.plan, model.settings);
  plain.run();
  Profiler profiler(seen.plan(), model.settings.stop, seen.max_step());
  seen.profile_with(profiler);
  seen.run();
  CHECK(seen.statistics().regular_hits == 0);
  CHECK(same_bits(seen.log().data(), plain.log().data()));
}
