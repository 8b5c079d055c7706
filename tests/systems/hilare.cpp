// The stepper-driven robot of models/hilare, closed loop, against two independent programs of the
// specification. Printed numbers are in mm and s, and their last digit is rounded.
#include <cmath>

#include "solvers/lane_simulator.h"
#include "tests/source_dir.h"
#include "tests/systems/harness.h"

namespace flyball::test {
namespace {

using Overrides = std::vector<Override>;

constexpr double mm = 1e-3;

Model hilare(const std::string& name, const Overrides& overrides = {}) {
  return load_model(source_dir() + "/models/hilare/" + name + ".toml", overrides);
}

/// k2 takes the distance to the side in metres, and gives 40 mm/s of way.
const Overrides in_metres{{"robot.k2", "2.9671 1/(m*mm)"}};
const Overrides without_steps{{"robot.drive.steps.whole_steps", "false"}};

Overrides both(Overrides a, const Overrides& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

struct Result {
  double end, segment, path, largest, speed;  // s, mm, mm, mm, mm/s
};

Result result_of(const std::string& name, const Overrides& overrides = {}) {
  Run run(hilare(name, overrides), {.enabled = false});
  run.finish();
  return {run.time(), run["off_segment.mean"] / mm, run["off_path.mean"] / mm,
          run["off_segment.largest"] / mm, run["speed_error.mean"] / mm};
}

/// Of a slot inside of subsystems.
double value(Run& run, const std::string& name) {
  const Plan& plan = run.plan();
  for (int slot = 0; slot < plan.layout.size; ++slot) {
    if (plan.slot_name(slot) == name) return run.simulator().workspace().values[slot];
  }
  throw std::invalid_argument("no slot " + name);
}

/// Half a unit of the last digit printed behind the point, and a little for its decimal form.
double printed(int digits) { return 0.5001 * std::pow(10.0, -digits); }

struct Checkpoint {
  double t, x, y, theta;
  int number;
};

/// At the tick that ends at t: a row of the run.
void check(const Run& run, const Checkpoint& c, double length, double angle) {
  INFO("t = " << c.t);
  CHECK(std::fabs(run.logged("robot.pose.x", c.t) / mm - c.x) <= length);
  CHECK(std::fabs(run.logged("robot.pose.y", c.t) / mm - c.y) <= length);
  CHECK(std::fabs(run.logged("robot.pose.theta", c.t) - c.theta) <= angle);
  CHECK(run.logged("selector.number", c.t) == c.number);
}

}  // namespace

TEST_CASE("The Hilare robot with its steps, gains in metres: each step is where it is printed") {
  Run run(hilare("rectangle", in_metres));
  run.finish();
  // Whole steps: the fourth digit of a mm and the fifth of a radian are all that is printed.
  for (const Checkpoint& c : {Checkpoint{1, 240.95, 200, 0, 1},
                              {5, 404.88, 200, 0, 1},
                              {9.5, 576.0958, 200.5451, 0.29130, 2},
                              {10, 585.6763, 205.7899, 0.66926, 2},
                              {12, 604.2915, 279.3653, 1.58167, 2},
                              {20, 505.9670, 505.3241, 3.15130, 3},
                              {30, 195.8390, 410.2497, 4.72333, 4},
                              {34.475, 197.7407, 226.8296, 4.72333, 4}}) {
    check(run, c, printed(4), printed(5));
  }
  CHECK(value(run, "robot.drive.steps.right_count") == 11284.0);
  CHECK(value(run, "robot.drive.steps.left_count") == 9322.0);
  CHECK(run.simulator().end_reason() == "end: the last waypoint is reached");
}

TEST_CASE("The Hilare robot with its steps, gains in mm: the end and the steps are those printed") {
  Run run(hilare("rectangle"));
  run.finish();
  check(run, {34.370, 199.50983, 226.88239, 4.732963, 4}, printed(5), printed(6));
  CHECK(value(run, "robot.drive.steps.right_count") == 11256.0);
  CHECK(value(run, "robot.drive.steps.left_count") == 9290.0);
}

TEST_CASE("The Hilare robot as if its motors turned evenly") {
  Run run(hilare("rectangle", both(in_metres, without_steps)));
  run.finish();
  for (const Checkpoint& c : {Checkpoint{1, 241, 200, 0, 1},
                              {9.5, 576.0098, 200.5845, 0.29880, 2},
                              {10, 585.7125, 205.9671, 0.67230, 2},
                              {12, 604.2004, 279.6415, 1.58113, 2},
                              {20, 505.4624, 505.2587, 3.15229, 3},
                              {30, 195.7232, 409.7277, 4.72319, 4}}) {
    check(run, c, printed(4), printed(5));
  }
  CHECK(run.time() == 34.465);
  CHECK(std::fabs(run["off_segment.mean"] / mm - 4.2966) <= printed(4));
  CHECK(std::fabs(run["off_path.mean"] / mm - 2.6183) <= printed(4));
  CHECK(std::fabs(run["speed_error.mean"] / mm - 2.8942) <= printed(4));
}

TEST_CASE("The Hilare robot on the paths of the paper") {
  struct Row {
    const char* path;
    bool metres;
    Result expected;
    int digits;  // behind the point
  };
  for (const Row& row : {Row{"rectangle", false, {34.370, 3.7839, 2.1099, 26.976, 2.8942}, 4},
                         {"rectangle", true, {34.475, 4.2980, 2.6223, 26.910, 2.8992}, 4},
                         {"rectangle_open", false, {26.755, 3.378, 1.948, 26.98, 2.613}, 3},
                         {"trapezoid", false, {34.815, 3.5763, 2.0610, 26.86, 2.6223}, 4},
                         {"trapezoid", true, {34.915, 4.1354, 2.6141, 26.94, 2.6318}, 4},
                         {"planner_path", false, {33.555, 8.777, 2.694, 26.99, 1.248}, 3},
                         {"planner_path", true, {33.325, 11.865, 7.521, 27.00, 1.231}, 3},
                         {"cursive", false, {43.365, 12.126, 5.264, 26.97, 2.690}, 3},
                         {"cursive", true, {39.610, 17.314, 13.899, 27.00, 2.585}, 3}}) {
    INFO(row.path << (row.metres ? ", gains in metres" : ""));
    const Result found = result_of(row.path, row.metres ? in_metres : Overrides{});
    CHECK(found.end == Approx(row.expected.end).epsilon(1e-12));  // on the grid of 5 ms
    CHECK(std::fabs(found.segment - row.expected.segment) <= printed(row.digits));
    CHECK(std::fabs(found.path - row.expected.path) <= printed(row.digits));
    CHECK(std::fabs(found.largest - row.expected.largest) <= printed(row.digits == 4 ? 2 : 2));
    CHECK(std::fabs(found.speed - row.expected.speed) <= printed(row.digits));
  }
}

TEST_CASE("The Hilare robot with other readings of its gains") {
  struct Row {
    const char *k2, *k3;
    double end, segment, speed;
  };
  // k2 on distances in cm; without the speed in the gains; with the speed in m/s; and on distances in m.
  for (const Row& row : {Row{"2.9671 1/cm^2", "0.552 1/cm", 34.370, 3.793, 2.886},
                         {"2.9671/40 1/mm^2", "0.552/40 1/mm", 34.365, 3.772, 2.888},
                         {"2.9671 1/(m*mm)", "0.552 1/m", 34.365, 3.784, 2.887},
                         {"2.9671e-3/40 1/mm^2", "0.552/40 1/mm", 34.740, 7.648, 2.827}}) {
    INFO(row.k2);
    const Result found = result_of("rectangle", {{"robot.k2", row.k2}, {"robot.k3", row.k3}});
    CHECK(std::fabs(found.end - row.end) <= 0.05);
    CHECK(std::fabs(found.segment - row.segment) <= 0.03);
    CHECK(std::fabs(found.speed - row.speed) <= 0.02);
  }
  // In SI the robot cannot turn at the first corner.
  Model in_si = hilare("rectangle", {{"robot.k2", "2.9671 1/m^2"}, {"robot.k3", "0.552 1/m"}});
  in_si.settings.stop = 120.0;
  Run si(in_si, {.enabled = false});
  si.finish();
  CHECK((si.time() == 120.0 && si["selector.done"] == 0.0));
}

TEST_CASE("The Hilare robot that does not know its heading is farther off than it can know") {
  for (const auto& [degrees, segment] :
       {std::pair{"0.5 deg", 4.52}, {"1 deg", 5.47}, {"1.5 deg", 6.55}, {"2 deg", 7.71}}) {
    INFO(degrees);
    CHECK(std::fabs(result_of("heading_error", {{"phi", degrees}}).segment - segment) <= printed(2));
  }
}

TEST_CASE("The Hilare robot among obstacles comes to its goal on the paths of six seeds") {
  for (const char* seed : {"0", "1", "2", "3", "4", "5"}) {
    INFO("seed " << seed);
    Run run(hilare("roadmap", {{"route.seed", seed}}), {.enabled = false});
    run.finish();
    CHECK(run["selector.done"] == 1.0);
    CHECK(run["off_path.largest"] < 0.03);  // the first turn, from a heading of 0
    CHECK(run["speed_error.mean"] < 2.5 * mm);
  }
}

TEST_CASE("The Hilare robot with other headings at its waypoints, and other steps") {
  const Result bearing = result_of("rectangle", {{"selector.heading", "bearing"}});
  CHECK(std::fabs(bearing.speed - 2.668) <= printed(3));
  // With the heading of the following way the robot creeps into its corner.
  Model next = hilare("rectangle", {{"selector.heading", "next"}});
  next.settings.stop = 120.0;
  Run creeping(next);
  creeping.finish();
  CHECK(creeping["selector.done"] == 0.0);
  CHECK(creeping.logged("selector.number", 109.10) == 1.0);
  CHECK(creeping.logged("selector.number", 109.12) == 2.0);
  // 1000 steps a turn; another track; no steps at all.
  const Result steps = result_of("rectangle", {{"robot.beta", "2*pi/1000 rad"}});
  CHECK(std::fabs(steps.segment - 3.7817) <= printed(4));
  CHECK(std::fabs(steps.speed - 2.8879) <= printed(4));
  const Result track = result_of("rectangle", {{"robot.w_T", "53 mm"}});
  CHECK(std::fabs(track.segment - 3.775) <= printed(3));
  CHECK(std::fabs(track.speed - 2.890) <= printed(3));
  // Bang-bang to the last bit: what the specification allows.
  const Result even = result_of("rectangle", without_steps);
  CHECK(std::fabs(even.segment - 3.8208) <= 0.03);
  CHECK(std::fabs(even.speed - 2.8800) <= 0.02);
  CHECK(std::fabs(even.end - 34.355) <= 0.05);
}

TEST_CASE("The Hilare robot at the limits of its motors, in three modes") {
  const auto finishes = [](const char* mode, const char* v_max) {
    Model model = hilare(
        "rectangle",
        {{"robot.controller.motors.mode", mode}, {"robot.v_max", v_max}, {"robot.omega_max", "1e9 rad/s"}});
    model.settings.stop = 120.0;
    Run run(model, {.enabled = false});
    run.finish();
    return run["selector.done"] == 1.0
               ? Result{run.time(), run["off_segment.mean"] / mm, 0.0, 0.0, run["speed_error.mean"] / mm}
               : Result{};
  };
  const Result kept = finishes("v_priority", "100 mm/s");
  CHECK(std::fabs(kept.end - 30.550) <= 0.05);
  CHECK(std::fabs(kept.segment - 3.448) <= 0.03);
  CHECK(std::fabs(kept.speed - 5.051) <= 0.02);
  // A huge turn leaves no speed.
  CHECK(finishes("curvature", "100 mm/s").end == 0.0);
  CHECK(finishes("omega_priority", "100 mm/s").end == 0.0);
  CHECK(finishes("curvature", "41 mm/s").end == 0.0);
}

TEST_CASE("The Hilare robot without a timer interrupt moves by one step a loop") {
  Run straight(hilare("polled"));
  while (straight.time() < 6.0) straight.advance();
  // 0.13 mm in 6 ms, from the first loop that has gathered a whole step.
  const double speed = (straight.logged("robot.pose.x", 6.0) - straight.logged("robot.pose.x", 3.0)) / 3.0;
  CHECK(std::fabs(speed / mm - 0.13 / 0.006) <= 1e-9);
  const Result found = result_of("polled");
  // Loops of 6 ms and steps of 0.13 mm: 3e-6 more of k2 moves the end by a second.
  CHECK(std::fabs(found.end - 74.62) <= 1.5);
  CHECK(std::fabs(found.segment - 3.63) <= 0.03);
  const Result metres = result_of("polled", in_metres);
  CHECK(std::fabs(metres.end - 68.60) <= 0.05);
  CHECK(std::fabs(metres.segment - 4.08) <= 0.03);
  // Where the limit of the motors does not know of the loop, both wheels step all the time: no turn.
  Model unaware = hilare("polled", {{"robot.omega_w", "3.25"}});
  unaware.settings.stop = 300.0;
  Run blind(unaware, {.enabled = false});
  blind.finish();
  CHECK((blind.time() == 300.0 && blind["selector.done"] == 0.0));
  CHECK(value(blind, "robot.drive.lost_turn.y") > 50.0);
}

TEST_CASE("The Hilare robot in lanes: each run is the run alone, and ends for itself") {
  const Model model = hilare("tuning");
  REQUIRE(refuses_lanes(*model.plan, model.settings).empty());
  std::vector<ParameterSet> sets;
  for (const double k1 : {0.0247, 0.05, 0.01, 0.08, 0.03})
    sets.push_back({{model.plan->parameter_slot("robot.k1"), k1}});
  sets.push_back({{model.plan->parameter_slot("robot.omega_max"), 0.0}});  // never turns, and runs to the end
  const auto outcomes = run_in_lanes(model.plan, model.settings, sets, {.log = {.enabled = true}});
  for (std::size_t k = 0; k < sets.size(); ++k) {
    INFO(k);
    Simulator alone(model.plan, model.settings);
    alone.set_parameter(model.plan->slot_name(sets[k][0].first), sets[k][0].second);
    alone.run();
    CHECK_FALSE(outcomes[k].alone);
    CHECK(outcomes[k].values[0] == alone.time());
    // Ticks are the same for all, so that lanes have the bits of the run alone.
    CHECK(outcomes[k].values == alone.workspace().values);
    REQUIRE(outcomes[k].log.has_value());
    CHECK(outcomes[k].log->rows() == alone.log().rows());
  }
  CHECK(outcomes[5].values[0] == 60.0);
}

}  // namespace flyball::test
