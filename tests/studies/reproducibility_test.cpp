// Equal runs give equal bytes, of the results and of what is written beside them: again and again, whatever
// ran before, and on any number of threads.
#include <algorithm>
#include <atomic>
#include <functional>
#include <random>
#include <thread>

#include "solvers/lane_simulator.h"
#include "solvers/parameters.h"
#include "studies/csv.h"
#include "studies/file.h"
#include "studies/metadata.h"
#include "tests/catch.h"
#include "tests/source_dir.h"

using namespace flyball;

namespace {

struct Model {
  RunInputs inputs;
  std::shared_ptr<const Plan> plan;
  SimulationSettings settings;
};

Model read(const std::string& name) {
  const std::string file = source_dir() + "/models/" + name + ".toml";
  Model model{{file, read_file(file), {}}, nullptr, {}};
  Diagnostics diagnostics(file);
  auto diagram = read_diagram(model.inputs.model_text, diagnostics);
  REQUIRE(diagram);
  model.settings = diagram->simulation;
  model.plan = make_plan(std::make_shared<const Diagram>(*std::move(diagram)), diagnostics);
  REQUIRE(model.plan);
  return model;
}

/// All that is written of one run.
std::string bytes(const Model& model) {
  const RunResult result = run_plan(model.plan, model.settings);
  const std::string csv = to_csv(result.log);
  return csv + metadata_json(result, model.inputs, "r.csv", csv);
}

/// Events; noise, samples and a file of values; three stiff ones, one with the sparse Jacobian; samples with
/// exact steps; two rates; a delay; loops that switch; Adams.
std::vector<Model> models() {
  std::vector<Model> all;
  for (const std::string name :
       {"classic/bouncing_ball", "classic/recorded_command", "classic/robertson", "ivp/oregonator",
        "ivp/hires", "classic/sampled_dc_motor", "classic/two_rate_loop", "classic/smith_predictor",
        "classic/diode_rectifier", "line_arc/arc_error_loop"}) {
    all.push_back(read(name));
  }
  return all;
}

/// Each number below `count`, `times` times, in an order of this seed.
std::vector<std::size_t> shuffled(std::size_t count, int times, unsigned seed) {
  std::vector<std::size_t> order;
  for (int k = 0; k < times; ++k) {
    for (std::size_t i = 0; i < count; ++i) order.push_back(i);
  }
  std::ranges::shuffle(order, std::mt19937(seed));
  return order;
}

/// Does `work` for each number below `count`, on as many threads.
void on_threads(int threads, std::size_t count, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  std::vector<std::jthread> all;
  for (int k = 0; k < threads; ++k) {
    all.emplace_back([&] {
      for (std::size_t i = next++; i < count; i = next++) work(i);
    });
  }
}

}  // namespace

TEST_CASE(
    "S32: a hundred runs of each model, in any order and on 1, 2, 4 and 8 threads, give the same bytes") {
#ifdef __SANITIZE_ADDRESS__
  constexpr int repeats = 2;  // on each number of threads: a sanitizer makes a run tens of times as long
#else
  constexpr int repeats = 25;
#endif
  const std::vector<Model> all = models();
  std::vector<std::string> first;
  for (const Model& model : all) first.push_back(bytes(model));
  for (const int threads : {1, 2, 4, 8}) {
    const auto order = shuffled(all.size(), repeats, static_cast<unsigned>(threads));
    std::vector<std::atomic<int>> differences(all.size());
    on_threads(threads, order.size(), [&](std::size_t k) {
      if (bytes(all[order[k]]) != first[order[k]]) ++differences[order[k]];
    });
    for (std::size_t m = 0; m < all.size(); ++m) {
      INFO(all[m].inputs.model_file << " on " << threads << " threads");
      CHECK(differences[m] == 0);
    }
  }
  // Read anew, they are other objects at other addresses.
  const std::vector<Model> anew = models();
  for (std::size_t m = 0; m < all.size(); ++m) CHECK(bytes(anew[m]) == first[m]);
}

TEST_CASE("S32: runs in lockstep give the same bytes on 1, 2, 4 and 8 threads, again and again") {
  const Model model = read("benchmarks/sweep");
  std::vector<ParameterSet> sets;
  const int slot = settable_parameter(*model.plan, "Kp");
  for (int k = 0; k < 37; ++k) sets.push_back({{slot, 1.0 + 0.1 * k}});
  const auto lanes = [&](int threads) {
    LaneOptions options;
    options.log.enabled = true;
    options.threads = threads;
    std::string text;
    for (const LaneOutcome& outcome : run_in_lanes(model.plan, model.settings, sets, options))
      text += to_csv(outcome.log.value());
    return text;
  };
  const std::string first = lanes(1);
  CHECK(first.size() > 37 * 100);
  for (const int threads : {1, 2, 4, 8, 8, 4, 2, 1}) {
    INFO(threads << " threads");
    CHECK(lanes(threads) == first);
  }
}
