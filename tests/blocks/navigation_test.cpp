// Navigation from point to point, with the test vectors of the specification: its millimetres are metres
// here, and the last printed digit is rounded.
#include <cmath>

#include "blocks/navigation/path.h"
#include "tests/blocks/bench.h"
#include "tests/catch.h"

namespace flyball::test {
namespace {

using namespace std::string_literals;

const Rational control = *Rational::fraction(5, 1000), tick = *Rational::fraction(1, 1000);
const NumberRows rectangle{{0.2, 0.2}, {0.6, 0.2}, {0.6, 0.5}, {0.2, 0.5}, {0.2, 0.2}};

struct Vector {
  double x, y, theta;
};

void put(Device& d, const std::string& port, const Vector& pose) {
  d[port + ".x"] = pose.x, d[port + ".y"] = pose.y, d[port + ".theta"] = pose.theta;
}

Device selector(const NumberRows& points, Keys keys = {}) {
  keys.insert({"sample_time", control});
  Device d("WaypointSelector", std::move(keys));
  Bench<double>& bench = d.bench();
  bench.objects[bench.spec().port("path")->slots[0]] = std::make_shared<const Path>(points);
  return d;
}

/// The number of the next point after a hit at a place.
double hit_at(Device& d, double x, double y) {
  put(d, "pose", {x, y, 0.0});
  return d.hit("number");
}

// Half of the last digit printed, of numbers in mm and in m, and rounding.
constexpr double printed_mm = 0.51e-12, printed = 0.51e-9;

}  // namespace

TEST_CASE("WaypointSelector goes on within the transition distance, equality included") {
  for (const auto& [x, number] :
       std::vector<std::pair<double, double>>{{0.57301, 2}, {0.57299, 1}, {0.573, 2}}) {
    Device d = selector(rectangle);
    CHECK(hit_at(d, x, 0.2) == number);
  }
}

TEST_CASE("WaypointSelector passes all points that are near at one hit") {
  Device d = selector({{0.0, 0.0}, {0.05, 0.0}, {0.06, 0.0}, {0.07, 0.0}, {0.15, 0.0}});
  CHECK(hit_at(d, 0.045, 0.0) == 4.0);
}

TEST_CASE("WaypointSelector shows the point, the one before, and the heading of the way between them") {
  Device d = selector(rectangle);
  CHECK(hit_at(d, 0.2, 0.2) == 1.0);
  CHECK(hit_at(d, 0.58, 0.21) == 2.0);
  CHECK((d["waypoint.x"] == 0.6 && d["waypoint.y"] == 0.5));
  CHECK((d["previous.x"] == 0.6 && d["previous.y"] == 0.2 && d["previous.theta"] == 0.0));
  CHECK(d["waypoint.theta"] == M_PI / 2.0);
  Device bearing = selector(rectangle, {{"heading", "bearing"s}});
  hit_at(bearing, 0.5, 0.1);
  CHECK(bearing["waypoint.theta"] == std::atan2(0.2 - opaque(0.1), 0.6 - opaque(0.5)));
  Device next = selector(rectangle, {{"heading", "next"s}});
  hit_at(next, 0.2, 0.2);
  CHECK(next["waypoint.theta"] == M_PI / 2.0);
}

TEST_CASE("WaypointSelector is done at the last point, which it goes on to show") {
  Device d = selector(rectangle);
  hit_at(d, 0.58, 0.2), hit_at(d, 0.6, 0.48), hit_at(d, 0.21, 0.5);
  CHECK((d["done"] == 0.0 && d["number"] == 4.0));
  CHECK(hit_at(d, 0.2, 0.226) == 4.0);
  CHECK(d["done"] == 1.0);
  CHECK((d["waypoint.x"] == 0.2 && d["previous.y"] == 0.5));
  hit_at(d, 5.0, 5.0);
  CHECK(d["done"] == 1.0);
}

TEST_CASE("WaypointSelector gives a waypoint its time, and starts anew with the next one") {
  Device d = selector(rectangle, {{"timeout", 3.0}});
  const auto at = [&](double t, double x) {
    d.time(t);
    hit_at(d, x, 0.2);
    return d["timed_out"];
  };
  CHECK(at(0.0, 0.2) == 0.0);
  CHECK(at(2.5, 0.58) == 0.0);
  CHECK(at(5.0, 0.58) == 0.0);
  CHECK(at(5.5, 0.58) == 1.0);
}

TEST_CASE("Waypoints refuses what is no path, and says where") {
  const auto refusal = [](Keys keys) {
    TableSettings settings(std::move(keys));
    find_block_type("Waypoints")->create(&settings);
    return settings.refused();
  };
  CHECK(refusal({{"points", NumberRows{{1.0, 2.0}}}}) ==
        Words{"points: expected at least two points, found 1"});
  CHECK(refusal({{"points", NumberRows{{1.0, 2.0}, {1.0}}}}) ==
        Words{"points: expected two lengths, x and y, found 1"});
  CHECK(refusal({{"points", rectangle}, {"file", rectangle}}) ==
        Words{"points: the points are those of the file"});
}

TEST_CASE("PoseError is the waypoint in the frame of the robot") {
  Device d("PoseError");
  struct Pair {
    Vector pose, waypoint, error;
  };
  for (const Pair& p :
       {Pair{{0.57323, 0.2, 0.0}, {0.6, 0.5, M_PI / 2.0}, {0.02677, 0.3, 1.570796327}},
        Pair{{0.25, 0.203, 0.02}, {0.6, 0.2, 0.0}, {0.349870006333, -0.009998933363, -0.02}},
        Pair{{0.4, 0.498, 3.0}, {0.2, 0.5, M_PI}, {0.198280739336, 0.026244016619, 0.141592654}}}) {
    put(d, "pose", p.pose), put(d, "waypoint", p.waypoint);
    d.update();
    CHECK(std::fabs(d["error.x"] - p.error.x) <= printed_mm);
    CHECK(std::fabs(d["error.y"] - p.error.y) <= printed_mm);
    CHECK(std::fabs(d["error.theta"] - p.error.theta) <= printed);
  }
}

TEST_CASE("KanayamaTracker gives the published commands, with its gains in both units") {
  struct Line {
    Vector error;
    double v, omega_mm, omega_m;
  };
  // 1/mm^2 and 1/mm; or 1/(m mm), which is k2 on a distance in metres.
  for (const double k2 : {2.9671e6, 2.9671e3}) {
    Device d("KanayamaTracker", {{"k1", 0.0247}, {"k2", k2}, {"k3", 552.0}});
    d["v_reference"] = 0.04;
    for (const Line& line :
         {Line{{0.02677, 0.3, M_PI / 2.0}, 0.000661219, 35627.28, 57.6852},
          Line{{0.349870006333, -0.009998933363, -0.02}, 0.048633789423, -1187.154977775, -1.628283968},
          Line{{0.198280739336, 0.026244016619, 3.141592653589793 - 3.0},
               0.044497234126,
               3117.860798160,
               6.230674646}}) {
      put(d, "error", line.error);
      d.update();
      CHECK(std::fabs(d["v"] - line.v) <= printed_mm);
      // The error itself is printed to 1e-12 m, half of which is worth v k2/2 1e-12 rad/s.
      const double expected = k2 > 1e6 ? line.omega_mm : line.omega_m;
      CHECK(std::fabs(d["omega"] - expected) <= printed + 0.04 * k2 * printed_mm);
    }
  }
}

TEST_CASE("Limits of the user, then those of the motors, in three modes") {
  struct Line {
    std::string mode;
    double v, omega, v_max, omega_max, v_out, omega_out, right, left;
  };
  for (const Line& line : {Line{"curvature", 49, 3, 41, 0.747, 41, 0.747, 3.05845, 1.04155},
                           Line{"omega_priority", 49, 3, 41, 0.747, 41, 0.747, 3.05845, 1.04155},
                           Line{"v_priority", 49, 3, 41, 0.747, 41, 0.747, 3.05845, 1.04155},
                           Line{"curvature", 80, -3, 100, 2, 38.805970149, -0.970149254, 0.630597015, 3.25},
                           Line{"omega_priority", 80, -3, 100, 2, 11, -2, -2.15, 3.25},
                           Line{"v_priority", 80, -3, 100, 2, 65, 0, 3.25, 3.25},
                           Line{"curvature", 10, 5, 100, 5, 4.482758621, 2.241379310, 3.25, -2.801724138},
                           Line{"omega_priority", 10, 5, 100, 5, 0, 2.407407407, 3.25, -3.25},
                           Line{"v_priority", 10, 5, 100, 5, 10, 2.037037037, 3.25, -2.25}}) {
    INFO(line.mode << " " << line.v << " " << line.omega);
    Device user("VelocityLimiter",
                {{"sample_time", control}, {"v_max", line.v_max * 1e-3}, {"omega_max", line.omega_max}});
    Device motors("MotorLimiter", {{"sample_time", control}, {"mode", line.mode}});
    user["v"] = line.v * 1e-3, user["omega"] = line.omega;
    user.update();
    motors["v"] = user["v_limited"], motors["omega"] = user["omega_limited"];
    motors.update();
    const double v = motors["v_limited"], omega = motors["omega_limited"];
    CHECK(std::fabs(v - line.v_out * 1e-3) <= printed_mm);
    CHECK(std::fabs(omega - line.omega_out) <= printed);
    CHECK(std::fabs((2.0 * v + 0.054 * omega) / 0.04 - line.right) <= printed);
    CHECK(std::fabs((2.0 * v - 0.054 * omega) / 0.04 - line.left) <= printed);
  }
}

TEST_CASE("VelocityLimiter keeps a turn between its limits on the side that it has, and tells when it acts") {
  Device d(
      "VelocityLimiter",
      {{"sample_time", control}, {"v_min", 0.01}, {"v_max", 0.05}, {"omega_min", 0.1}, {"omega_max", 0.5}});
  const auto at = [&](double v, double omega) {
    d["v"] = v, d["omega"] = omega;
    d.update();
    return std::vector{d["v_limited"], d["omega_limited"], d["limits_v"], d["limits_omega"]};
  };
  CHECK(at(0.02, 0.2) == std::vector{0.02, 0.2, 0.0, 0.0});
  CHECK(at(-1.0, -0.05) == std::vector{0.01, -0.1, 1.0, 1.0});
  CHECK(at(0.06, -3.0) == std::vector{0.05, -0.5, 1.0, 1.0});
  CHECK(at(0.03, 0.0) == std::vector{0.03, 0.0, 0.0, 0.0});
}

TEST_CASE("MotorLimiter tells its share, passes what is within it, and stands still when told to") {
  Device d("MotorLimiter", {{"sample_time", control}});
  d["v"] = 0.08, d["omega"] = -3.0;
  d.update();
  // 65/(80 + 27*3)
  CHECK(std::fabs(d["scale"] - 65.0 / 161.0) <= 4 * 0x1p-53);
  d["v"] = 0.041, d["omega"] = 0.747;
  d.update();
  CHECK((d["scale"] == 1.0 && d["v_limited"] == 0.041 && d["omega_limited"] == 0.747));
  d["v"] = 0.0, d["omega"] = 0.0;
  d.update();
  CHECK((d["scale"] == 1.0 && d["v_limited"] == 0.0));
  d["v"] = 0.041, d["stop"] = 1.0;
  d.update();
  CHECK((d["v_limited"] == 0.0 && d["omega_limited"] == 0.0));
}

namespace {

struct Steps {
  std::vector<int> right, left;
  double right_rest, left_rest;
};

Steps steps_of(double step_angle) {
  Device d("StepGenerator", {{"sample_time", tick}, {"step_angle", step_angle}});
  Steps all{};
  for (int k = 0; k < 20; ++k) {
    d["right"] = 3.0, d["left"] = -1.7;
    all.right.push_back(static_cast<int>(d.hit("right_step")));
    all.left.push_back(static_cast<int>(d["left_step"]));
  }
  all.right_rest = d["right_rest"], all.left_rest = d["left_rest"];
  return all;
}

}  // namespace

TEST_CASE("StepGenerator steps as the specification prints it") {
  const Steps a = steps_of(0.0065);
  CHECK(a.right == std::vector{0, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 0, 1, 0, 1, 0, 1});
  CHECK(a.left == std::vector{0, 0, 0, -1, 0, 0, 0, -1, 0, 0, 0, -1, 0, 0, 0, -1, 0, 0, 0, -1});
  // Twenty sums of numbers below 0.01, each rounded.
  CHECK(std::fabs(a.right_rest - 0.0015) <= 40 * 0x1p-60);
  CHECK(std::fabs(a.left_rest + 0.0015) <= 40 * 0x1p-60);
  const Steps b = steps_of(2.0 * M_PI / 1000.0);
  CHECK(b.right == std::vector{0, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0});
  CHECK(b.left == std::vector{0, 0, 0, -1, 0, 0, 0, -1, 0, 0, 0, -1, 0, 0, -1, 0, 0, 0, -1, 0});
  CHECK(std::fabs(b.right_rest - 0.003451332) <= printed);
  CHECK(std::fabs(b.left_rest + 0.002584073) <= printed);
}

TEST_CASE("StepGenerator counts its steps, and the turn that came too fast for them") {
  // 12 rad/s turn 0.012 rad a hit: more than one step of 0.0065 rad, less than two, so that every other hit
  // or so loses one.
  Device d("StepGenerator", {{"sample_time", tick}});
  const int hits = 100;
  for (int k = 0; k < hits; ++k) {
    d["right"] = 12.0, d["left"] = -6.0;
    d.hit("right_step");
  }
  // 0.6 rad are 92.3 steps.
  CHECK((d["right_count"] == hits && d["left_count"] == -92.0));
  // What was asked for was stepped, lost, or is left over.
  const double turn = 0.0065 * d["right_count"] + d["right_lost"] + d["right_rest"];
  CHECK(std::fabs(turn - 0.012 * hits) <= 1e-12);  // of 300 roundings at 1
  CHECK((d["right_lost"] > 0.5 && std::fabs(d["right_rest"]) < 0.0065));
  CHECK(d["left_lost"] == 0.0);
}

TEST_CASE("StepperWheelSpeed is a step in a hit") {
  Device d("StepperWheelSpeed", {{"sample_time", tick}});
  d["right_step"] = 1.0, d["left_step"] = -1.0;
  d.update();
  CHECK(std::fabs(d["right"] - 6.5) <= 2 * 6.5 * 0x1p-53);
  CHECK(d["left"] == -d["right"]);
  // A single right step, with v = dw/4 (right + left) and omega = dw/(2 wT) (right - left).
  CHECK(std::fabs(0.04 / 4.0 * d["right"] - 0.065) <= printed_mm);
  CHECK(std::fabs(0.04 / (2.0 * 0.054) * d["right"] - 2.407407407) <= printed);
}

}  // namespace flyball::test
