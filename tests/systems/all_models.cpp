#include <cmath>
#include <filesystem>

#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

namespace {

std::vector<std::string> model_files() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(FLYBALL_SOURCE_DIR "/models")) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path().string());
  }
  std::ranges::sort(files);
  return files;
}

/// The final states under a method at a tight tolerance.
std::vector<double> final_states(Model model, const std::string& method) {
  model.settings.method = method;
  model.settings.rtol = 1e-10;
  model.settings.atol = 1e-12;
  Simulator simulator(model.plan, model.settings, {false});
  simulator.run();
  const auto begin = simulator.workspace().values.begin();
  return {begin + model.plan->layout.first_state, begin + model.plan->layout.first_held};
}

}  // namespace

TEST_CASE("Every shipped model reads, plans and runs to its end") {
  REQUIRE(model_files().size() >= 10);
  for (const std::string& file : model_files()) {
    INFO(file);
    const Model model = load_model(file);
    CHECK_FALSE(model.plan->diagram->title.empty());
    Run run(model);
    run.finish();
    CHECK(run.time() == model.settings.stop);
    CHECK(run.simulator().log().rows() >= 2);
    CHECK_FALSE(run.simulator().log().columns().empty());
  }
}

TEST_CASE("Two methods agree on every shipped model without hits") {
  for (const std::string& file : model_files()) {
    Model model = load_model(file);
    if (!model.plan->hit_rates.empty()) continue;
    INFO(file);
    // Where errors grow (Lorenz) or an explicit method would crawl (stiff diagrams), the beginning must do.
    model.settings.stop = std::min(model.settings.stop, model.settings.method == "bdf" ? 1.0 : 5.0);
    model.settings.max_step = model.settings.max_step.value_or(model.settings.stop / 50.0);
    const std::vector<double> reference = final_states(model, "dp5");
    for (const std::string method : {"adams", "bdf"}) {
      INFO(method);
      const std::vector<double> states = final_states(model, method);
      for (std::size_t k = 0; k < states.size(); ++k)
        CHECK(std::fabs(states[k] - reference[k]) / (1e-12 + 1e-10 * std::fabs(reference[k])) < 1e4);
    }
  }
}
