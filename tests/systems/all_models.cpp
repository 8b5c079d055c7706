#include <cmath>

#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

namespace {

/// Where a run ends, and what it had on the way.
struct End {
  std::vector<double> states;
  std::vector<double> largest;  // of the absolute values of each state
  long steps = 0;
};

/// The end of a run under a method at a tight tolerance.
End end_of(Model model, const std::string& method) {
  model.settings.method = method;
  model.settings.rtol = 1e-10;
  model.settings.atol = 1e-12;
  Simulator simulator(model.plan, model.settings, {false});
  End end;
  end.largest.resize(model.plan->layout.states());
  for (bool more = true; more;) {
    more = simulator.advance();
    const auto begin = simulator.workspace().values.begin();
    end.states.assign(begin + model.plan->layout.first_state, begin + model.plan->layout.first_held);
    for (std::size_t k = 0; k < end.states.size(); ++k)
      end.largest[k] = std::max(end.largest[k], std::fabs(end.states[k]));
  }
  end.steps = simulator.statistics().stepper.steps;
  return end;
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
    CHECK((run.time() == model.settings.stop || !run.simulator().end_reason().empty()));
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
    const End reference = end_of(model, "dp5");
    for (const std::string method : {"adams", "bdf"}) {
      INFO(method);
      const End end = end_of(model, method);
      // Each step may add a tolerance of what the state was then; most add far less, which leaves room for
      // what Lorenz's loop amplifies.
      const double allowed = static_cast<double>(end.steps + reference.steps);
      for (std::size_t k = 0; k < end.states.size(); ++k) {
        const double tolerance = 1e-12 + 1e-10 * reference.largest[k];
        CHECK(std::fabs(end.states[k] - reference.states[k]) / tolerance < allowed);
      }
    }
  }
}
