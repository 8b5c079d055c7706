// Motions of the plane, and the blocks that make a pose of them. Lengths are in the unit of the printed
// numbers.
#include <cmath>

#include "blocks/jet.h"
#include "blocks/se2.h"
#include "tests/blocks/bench.h"
#include "tests/catch.h"

namespace flyball::test {
namespace {

using namespace std::string_literals;

/// Half a unit of the last digit that a printed number has behind the point.
constexpr double half_digit(int digits) { return digits == 0 ? 0.5 : half_digit(digits - 1) / 10.0; }

void check_pose(const Pose<double>& pose, const Pose<double>& expected, double tolerance) {
  CHECK(std::fabs(pose.x - expected.x) <= tolerance);
  CHECK(std::fabs(pose.y - expected.y) <= tolerance);
  CHECK(std::fabs(pose.theta - expected.theta) <= tolerance);
}

Device integrator(const std::string& method, const Pose<double>& start, double ts, double v, double omega) {
  Device d = sampled(
      "PoseIntegrator",
      {{"method", method}, {"initial_x", start.x}, {"initial_y", start.y}, {"initial_theta", start.theta}});
  d["sample_time"] = ts;
  d["v"] = v;
  d["omega"] = omega;
  return d;
}

Pose<double> shown(Device& d) { return {d["pose.x"], d["pose.y"], d["pose.theta"]}; }

/// The pose after n more hits.
Pose<double> after(Device& d, int n) {
  for (int k = 0; k < n; ++k) d.hit("pose.x");
  d.update();
  return shown(d);
}

}  // namespace

TEST_CASE("sinc and its slope are those of their series, on both sides of where the formula begins") {
  for (const double x : {0.0, 1e-300, 1e-9, 1e-3, 0.0999999, 0.1, 0.1000001, 0.7, -0.05, -2.0, M_PI}) {
    INFO(x);
    long double term = 1.0L, value = 1.0L, slope = 0.0L;
    for (int k = 1; k < 30; ++k) {
      if (x != 0.0) slope += term * -x / ((2 * k) * (2 * k + 1)) * (2 * k);
      term *= -static_cast<long double>(x) * x / ((2 * k) * (2 * k + 1));
      value += term;
    }
    // A quotient of two roundings; the slope divides the difference of two such numbers by x >= 0.1.
    CHECK(std::fabs(sinc_value(x) - static_cast<double>(value)) <= 2 * 0x1p-53);
    CHECK(std::fabs(sinc_slope(x) - static_cast<double>(slope)) <= 40 * 0x1p-53);
    const Jet jet = sinc(Jet(x, 0));
    CHECK(jet.a == sinc_value(x));
    CHECK(jet.v[0] == sinc_slope(x));
  }
}

TEST_CASE("the arcsine is a right angle beyond 1, where it is level") {
  CHECK(saturated_asin(0.5) == std::asin(opaque(0.5)));
  for (const double x : {1.0, 1.5, 1e9}) {
    CHECK(saturated_asin(x) == M_PI_2);
    CHECK(saturated_asin(-x) == -M_PI_2);
    CHECK(saturated_asin(Jet(x, 0)).v[0] == 0.0);
  }
}

TEST_CASE("a body moves exactly under velocities that are constant in its frame") {
  const auto by = [](double vx, double vy, double omega, double t) {
    return Increment<double>{vx * t, vy * t, omega * t};
  };
  check_pose(moved({1.0, 2.0, 0.5}, by(0.45, -0.3, 1.0, 0.2)), {1.1079785792668, 2.0012955239826, 0.7},
             half_digit(13));
  check_pose(moved({0.0, 0.0, 0.0}, by(0.45, 0.3, 0.0, 2.0)), {0.9, 0.6, 0.0}, 0x1p-52);
  // Trajectory rollouts of 1.7 s.
  check_pose(moved({0.0, 0.0, 0.0}, by(0.45, -0.3, 1.0, 1.7)), {0.784902513, 0.210480579, 1.7},
             half_digit(9));
  check_pose(moved({0.0, 0.0, 0.0}, by(0.3, 0.0, 0.2, 1.7)), {0.500230638, 0.085868002, 0.34}, half_digit(9));
}

TEST_CASE("a motion and its reverse end where they began") {
  const Pose<double> start{0.3, -0.7, 2.0};
  const Pose<double> there = moved(start, {0.4, 0.1, 3.0});
  // Backwards in the frame of the end: the chord turned by 3 rad, the other way.
  const Point<double> home = seen_from(there, {start.x, start.y});
  const double share = sinc(1.5), c = std::cos(-1.5), s = std::sin(-1.5);
  const Increment<double> back{(c * home.x + s * home.y) / share, (c * home.y - s * home.x) / share, -3.0};
  check_pose(moved(there, back), start, 10 * 0x1p-52);
}

TEST_CASE("points as a body sees them, and their distances") {
  const Point<double> seen = seen_from(Pose<double>{1.0, 2.0, M_PI_2}, Point<double>{0.0, 5.0});
  CHECK(std::fabs(seen.x - 3.0) <= 4 * 0x1p-53);
  CHECK(std::fabs(seen.y - 1.0) <= 4 * 0x1p-53);
  CHECK(right_of_line<double>({30.0, 500.0}, {0.0, 0.0}, {0.0, 2000.0}) == 30.0);
  CHECK(std::fabs(right_of_line<double>({300.0, 500.0}, {0.0, 0.0}, {1000.0, 1000.0}) + 141.421356237) <=
        half_digit(9));
  const Point<double> a{0.0, 0.0}, b{10.0, 0.0}, one{1.0, 1.0};
  CHECK(distance_from_segment<double>({3.0, 4.0}, a, b) == 4.0);
  CHECK(distance_from_segment<double>({12.0, 0.0}, a, b) == 2.0);
  CHECK(distance_from_segment<double>({-3.0, 4.0}, a, b) == 5.0);
  CHECK(distance_from_segment<double>({4.0, 5.0}, one, one) == 5.0);
}

TEST_CASE("PoseIntegrator: the published steps of its three methods") {
  struct Vector {
    const char* method;
    double x, y, far_x, far_y;
  };
  for (const Vector& m : {Vector{"euler", 200.057042867, 200.031162660, 10.806046117, 16.829419696},
                          Vector{"midpoint", 200.057005315, 200.031231300, 7.493502065, 18.543123437},
                          Vector{"exact", 200.057005301, 200.031231293, 7.450021272, 18.435527588}}) {
    INFO(m.method);
    Device step = integrator(m.method, {200.0, 200.0, 0.5}, 1e-3, 65.0, 2.407407407);
    check_pose(after(step, 1), {m.x, m.y, 0.502407407}, half_digit(9));
    Device far = integrator(m.method, {0.0, 0.0, 1.0}, 0.5, 40.0, 0.747);
    check_pose(after(far, 1), {m.far_x, m.far_y, 1.3735}, half_digit(9));
  }
}

TEST_CASE("PoseIntegrator: the order of its methods on a circle") {
  const double v = 0.5, omega = 0.8, end = 4.0;
  const double x = v / omega * std::sin(omega * end), y = v / omega * (1.0 - std::cos(omega * end));
  const auto error = [&](const char* method, int n) {
    Device d = integrator(method, {0.0, 0.0, 0.0}, end / n, v, omega);
    const Pose<double> pose = after(d, n);
    return std::hypot(pose.x - x, pose.y - y);
  };
  CHECK(error("exact", 1) < 1e-15);
  CHECK(error("exact", 1000) < 1e-13);  // a rounding each step
  // The next term of the error is smaller by omega*step = 0.03.
  CHECK(error("euler", 100) / error("euler", 200) == Approx(2.0).epsilon(0.03));
  CHECK(error("midpoint", 100) / error("midpoint", 200) == Approx(4.0).epsilon(0.03));
}

TEST_CASE("PoseIntegrator shows the pose at the hit, and moves sideways where it can") {
  Device d = sampled("PoseIntegrator", {{"sideways", true}, {"initial_x", 3.0}});
  d["sample_time"] = 2.0;
  d["v"] = 0.45, d["vy"] = 0.3, d["omega"] = 0.0;
  CHECK(d.hit("pose.x") == 3.0);
  CHECK(d.hit("pose.x") == 3.9);
  CHECK(d["pose.y"] == 0.6);
  const Specification& spec = d.bench().spec();
  const SlotSpec& shown_first = spec.slots[spec.port("pose")->slots[0]];
  CHECK(spec.slots[shown_first.initial_param].name == "initial_x");
}

TEST_CASE("DifferentialDriveInverse: the published wheel speeds") {
  Device d("DifferentialDriveInverse", {{"wheel_diameter", 40.0}, {"track_width", 54.0}});
  struct Vector {
    double v, omega, right, left;
  };
  for (const Vector& x : {Vector{40.0, 0.3, 2.405, 1.595}, Vector{0.0, -0.747, -1.00845, 1.00845},
                          Vector{41.0, 0.747, 3.05845, 1.04155}}) {
    d["v"] = x.v, d["omega"] = x.omega;
    d.update();
    // Numbers below 100, rounded four times, over 40.
    CHECK(std::fabs(d["right"] - x.right) <= 4 * 100 * 0x1p-53 / 40);
    CHECK(std::fabs(d["left"] - x.left) <= 4 * 100 * 0x1p-53 / 40);
  }
}

TEST_CASE("DifferentialDriveForward undoes DifferentialDriveInverse") {
  Device inverse("DifferentialDriveInverse"), forward("DifferentialDriveForward");
  inverse["v"] = 0.3, inverse["omega"] = -1.7;
  inverse.update();
  forward["right"] = inverse["right"], forward["left"] = inverse["left"];
  forward.update();
  // Wheel speeds up to 20 rad/s, rounded a few times; omega has the factor dw/(2 wT) = 0.37.
  CHECK(std::fabs(forward["v"] - 0.3) <= 20 * 4 * 0x1p-53);
  CHECK(std::fabs(forward["omega"] + 1.7) <= 20 * 4 * 0x1p-53);
}

TEST_CASE("WheelMotors lag behind commands that they overdo") {
  Device d("WheelMotors", {{"time_constant", 0.25}, {"right_mismatch", 0.5}, {"initial_left", 2.0}});
  d["right_command"] = 4.0, d["left_command"] = 3.0;
  d.update();
  CHECK((d["right"] == 0.0 && d["left"] == 2.0));
  CHECK(d.rate("right_speed") == 24.0);
  CHECK(d.rate("left_speed") == 4.0);
}

TEST_CASE("WheelSlip loses a part of what the wheels turn") {
  Device d("WheelSlip", {{"right_slip", 0.25}, {"left_slip", -0.5}});
  d["right_turning"] = 4.0, d["left_turning"] = 4.0;
  d.update();
  CHECK((d["right"] == 3.0 && d["left"] == 6.0));
}

}  // namespace flyball::test
