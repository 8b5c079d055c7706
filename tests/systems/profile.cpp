#include "solvers/profile.h"

#include <algorithm>

#include "tests/source_dir.h"
#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

namespace {

Model shipped(const std::string& name, const std::string& method) {
  Model model = load_model(source_dir() + "/models/" + name + ".toml");
  model.settings.method = method;
  return model;
}

/// Runs to the end.
Profile profile_of(Simulator& simulator, double stop) {
  Profiler profiler(simulator.plan(), stop, simulator.max_step());
  simulator.profile_with(profiler);
  simulator.run();
  return simulator.profile(profiler);
}

Profile profile_of(const Model& model) {
  Simulator simulator(model.plan, model.settings);
  return profile_of(simulator, model.settings.stop);
}

long count_of(const std::vector<Profile::Count>& counts, const std::string& name) {
  const auto found = std::ranges::find(counts, name, &Profile::Count::name);
  return found == counts.end() ? 0 : found->count;
}

long steps_in(const Profile& profile) {
  long steps = 0;
  for (const Profile::Span& span : profile.spans) steps += span.steps;
  return steps;
}

bool has_time(const Profile& profile, const std::string& block) {
  const auto found = std::ranges::find(profile.blocks, block, &BlockTime::name);
  return found != profile.blocks.end() && found->seconds > 0.0;
}

}  // namespace

TEST_CASE("A profile does not change its run") {
  for (const std::string method : {"auto", "bdf"}) {
    INFO(method);
    const Model model = shipped("classic/bouncing_ball", method);
    Simulator plain(model.plan, model.settings), seen(model.plan, model.settings);
    plain.run();
    profile_of(seen, model.settings.stop);
    CHECK(seen.log().data() == plain.log().data());
    CHECK(seen.statistics().stepper.rate_evaluations == plain.statistics().stepper.rate_evaluations);
  }
}

TEST_CASE("A profile counts each step once") {
  for (const std::string method : {"dp5", "bdf", "rk4"}) {
    INFO(method);
    const Model model = shipped("classic/van_der_pol", method);
    Simulator simulator(model.plan, model.settings);
    const Profile profile = profile_of(simulator, model.settings.stop);
    CHECK(steps_in(profile) == simulator.statistics().stepper.steps);
    CHECK(profile.until_instant + profile.at_max_step + profile.by_method == steps_in(profile));
    CHECK(profile.spans.front().begin == 0.0);
    CHECK(profile.spans.back().end == model.settings.stop);
    double longest = 0.0;
    for (const Profile::Span& span : profile.spans) {
      CHECK(span.shortest <= span.longest);
      longest = std::max(longest, span.longest);
    }
    CHECK(longest <= simulator.max_step() * (1.0 + 1e-9));  // ends are rounded
    long limited = 0;
    for (const Profile::Count& state : profile.limiting) limited += state.count;
    CHECK(limited == (method == "rk4" ? 0 : profile.by_method));  // rk4 estimates no error
  }
}

TEST_CASE("A profile names the state that limits the steps") {
  const Profile profile = profile_of(shipped("classic/robertson", "dp5"));
  // An explicit method is held by the fast substance all along: 34 589 steps.
  REQUIRE_FALSE(profile.limiting.empty());
  CHECK(profile.limiting.front().name == "B.x");
  CHECK(profile.limiting.front().count > 30000);
}

TEST_CASE("A profile counts events, alarms and hits by block") {
  const Model ball = shipped("classic/bouncing_ball", "auto");
  CHECK(count_of(profile_of(ball).events, "crossing ball.ground") == 19);
  const Profile motor = profile_of(shipped("classic/sampled_dc_motor", "dp5"));
  CHECK(count_of(motor.events, "hits of controller") == 10001);
  CHECK(count_of(motor.events, "alarm load.jump") == 1);
}

TEST_CASE("A profile estimates the time of each block that runs") {
  const Profile robertson = profile_of(shipped("classic/robertson", "bdf"));
  for (const std::string block : {"slow", "fast", "back", "A", "(Jacobian)"}) {
    INFO(block);
    CHECK(has_time(robertson, block));
  }
  CHECK(robertson.points >= 40);  // one in each fiftieth of the run in which a step begins
  CHECK(std::ranges::is_sorted(robertson.blocks, std::greater<>(), &BlockTime::seconds));
  // Where one matrix stands for all rates, no block has their time; the sweeps of hits are its own.
  const Profile motor = profile_of(shipped("classic/sampled_dc_motor", "dp5"));
  CHECK(has_time(motor, "(all rates, as one matrix)"));
  CHECK(has_time(motor, "controller"));
}
