#include <cstring>
#include <thread>

#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

namespace {

/// Something of everything: states, a limit, a relay, a sampled controller of two rates, pulses, a ball.
Model mixed(const std::string& method) {
  return read_model(R"toml(
flyball = 1
[blocks]
pulse = { type = "PulseGenerator", period = 1.7, duty = 0.3 }
sine = { type = "SineWave", frequency = 2.0 }
error = { type = "Sum", signs = "++-" }
sample = { type = "ZeroOrderHold", sample_time = "1/10 s" }
pid = { type = "DiscretePID", sample_time = "1/30 s", Kp = 2.0, Ki = 1.0, lower = -1.5, upper = 1.5 }
relay = { type = "Relay", switch_on = 0.2, switch_off = -0.2 }
drive = { type = "Sum" }
plant = { type = "TransferFcn", numerator = [2.0], denominator = [1.0, 0.4, 1.0] }
limit = { type = "Saturation", upper = 0.6, lower = -0.6 }
ball = { type = "BouncingBall", restitution = 0.9 }
[diagram]
wires = ["pulse -> error.u1", "sine -> error.u2", "plant -> error.u3", "error -> sample -> pid -> drive.u1",
         "error -> relay -> drive.u2", "drive -> plant -> limit"]
log = ["plant", "limit", "pid", "relay", "ball.height", "pulse"]
[simulation]
stop = 8
solver = { method = ")toml" +
                    method + "\" }\n");
}

std::vector<double> record(const Model& model) {
  Simulator simulator(model.plan, model.settings);
  simulator.run();
  return simulator.log().data();
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

}  // namespace

TEST_CASE("S32: one plan on eight threads gives the same bits eight times") {
  for (const std::string method : {"dp5", "bdf"}) {
    INFO(method);
    const Model model = mixed(method);
    const std::vector<double> alone = record(model);
    REQUIRE(alone.size() > 1000 * 7);
    std::vector<std::vector<double>> records(8);
    {
      std::vector<std::jthread> threads;
      for (auto& result : records) threads.emplace_back([&] { result = record(model); });
    }
    for (const auto& result : records) CHECK(same_bits(result, alone));
  }
}

TEST_CASE("S32: a model that is read twice gives the same bits") {
  CHECK(same_bits(record(mixed("dp5")), record(mixed("dp5"))));
}

TEST_CASE("S33: a run that goes on from a copied workspace gives the same bits") {
  for (const std::string method : {"auto", "dp5", "rk4", "heun", "euler"}) {
    INFO(method);
    const Model model = mixed(method);
    Simulator whole(model.plan, model.settings);
    auto first = std::make_unique<Simulator>(model.plan, model.settings);
    while (first->time() < 3.3) {
      first->advance();
      whole.advance();
    }
    const Workspace<double> checkpoint = first->workspace();
    const std::int64_t rows = first->log().rows();
    first.reset();
    Simulator second(model.plan, model.settings, checkpoint);
    while (whole.advance()) {
    }
    second.run();
    const auto rest = whole.log().data().begin() + rows * (whole.log().width() + 1);
    CHECK(same_bits(std::vector<double>(rest, whole.log().data().end()), second.log().data()));
    CHECK(whole.workspace().values == second.workspace().values);
  }
}

TEST_CASE("S33: a multistep method begins anew at a checkpoint, within the tolerance") {
  for (const std::string method : {"adams", "bdf"}) {
    INFO(method);
    const Model model = mixed(method);
    Simulator whole(model.plan, model.settings);
    Simulator first(model.plan, model.settings);
    while (first.time() < 3.3) first.advance();
    Simulator second(model.plan, model.settings, first.workspace());
    whole.run();
    second.run();
    const int plant = model.plan->layout.first_state;
    // Some hundreds of steps, each within rtol = 1e-6 of values below 10.
    for (int k = plant; k < model.plan->layout.first_held; ++k)
      CHECK(std::fabs(whole.workspace().values[k] - second.workspace().values[k]) < 1e-3);
  }
}

namespace {

/// Some hits of a noise block that drives a plant, under a method and a tolerance.
std::vector<double> noise(const std::string& method, double rtol, std::uint64_t seed,
                          const std::string& more = "") {
  Model model = read_model(R"toml(
flyball = 1
[blocks]
noise = { type = "RandomNumber", sample_time = "10 ms" }
plant = { type = "TransferFcn" }
)toml" + more + R"toml(
[diagram]
wires = ["noise -> plant"]
log = ["noise"]
[simulation]
stop = "1 s"
log_interval = "10 ms"
)toml");
  model.settings.method = method;
  model.settings.rtol = rtol;
  model.settings.seed = seed;
  return Run(model, {true, EventRows::after}).finish().column("noise");
}

}  // namespace

TEST_CASE("S40: random numbers depend on seed, name and hit, and on nothing else") {
  const std::vector<double> reference = noise("dp5", 1e-6, 1);
  CHECK(reference.size() == 101);
  CHECK(same_bits(reference, noise("dp5", 1e-10, 1)));
  CHECK(same_bits(reference, noise("bdf", 1e-6, 1)));
  CHECK(same_bits(reference, noise("euler", 1e-6, 1)));
  CHECK(same_bits(reference,
                  noise("dp5", 1e-6, 1, "another = { type = \"RandomNumber\", sample_time = \"3 ms\" }")));
  const std::vector<double> other = noise("dp5", 1e-6, 2);
  for (std::size_t k = 0; k < reference.size(); ++k) CHECK(reference[k] != other[k]);
}

TEST_CASE("S40: blocks of one structure have numbers of their own") {
  Run run(R"toml(
flyball = 1
[blocks]
a = { type = "RandomNumber", sample_time = "10 ms" }
b = { type = "RandomNumber", sample_time = "10 ms" }
[diagram]
log = ["a", "b"]
[simulation]
stop = "0.1 s"
)toml");
  run.finish();
  CHECK(run["a.y"] != run["b.y"]);
}
