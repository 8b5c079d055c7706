// Kinematics of robots. Printed numbers are given with nine digits behind the point.
#include <array>
#include <cmath>

#include "tests/blocks/bench.h"
#include "tests/catch.h"

namespace flyball::test {
namespace {

constexpr double printed = 0.5e-9;
constexpr double degree = M_PI / 180.0;
using Motion = std::array<double, 3>;  // vx, vy, omega
using Wheels = std::array<double, 4>;  // front right, front left, rear left, rear right

const std::array<std::string, 3> motions{"vx", "vy", "omega"};
const std::array<std::string, 4> wheels{"front_right", "front_left", "rear_left", "rear_right"};

/// The same motion in the frame of the paper, which has x to the right and y forward.
Motion from_paper(const Motion& m) { return {m[1], -m[0], m[2]}; }

void check_inverse(Device& d, const Motion& motion, const Wheels& expected, double tolerance) {
  for (int k = 0; k < 3; ++k) d[motions[k]] = motion[k];
  d.update();
  for (int k = 0; k < 4; ++k) {
    INFO(wheels[k] << " for " << motion[0] << ' ' << motion[1] << ' ' << motion[2]);
    CHECK(std::fabs(d[wheels[k]] - expected[k]) <= tolerance);
  }
}

void check_forward(Device& d, const Wheels& speeds, const Motion& expected, double slip, double tolerance) {
  for (int k = 0; k < 4; ++k) d[wheels[k]] = speeds[k];
  d.update();
  for (int k = 0; k < 3; ++k) {
    INFO(motions[k] << " for " << speeds[0] << ' ' << speeds[1] << ' ' << speeds[2] << ' ' << speeds[3]);
    CHECK(std::fabs(d[motions[k]] - expected[k]) <= tolerance);
  }
  CHECK(std::fabs(d["slip"] - slip) <= tolerance);
}

// A sum of at most four products below 25, each rounded a few times.
constexpr double rounding = 25 * 16 * 0x1p-53;

}  // namespace

TEST_CASE("DifferentialDrive turns wheel speeds into motion") {
  Device d("DifferentialDrive", {{"wheel_diameter", 0.04}, {"track_width", 0.054}, {"initial_theta", 0.5}});
  // v = (dw/4)(right + left), omega = dw/(2 wT) (right - left); the last of ten printed digits is rounded.
  struct Vector {
    double right, left, v, omega;
  };
  for (const Vector& x : {Vector{3.05845, 1.04155, 0.041, 0.747}, Vector{6.5, -6.5, 0.0, 4.814814815},
                          Vector{6.5, 0.0, 0.065, 2.407407407}, Vector{2.405, 1.595, 0.04, 0.3}}) {
    d["right"] = x.right, d["left"] = x.left;
    d.update();
    CHECK(std::fabs(d["v"] - x.v) <= printed);
    CHECK(std::fabs(d["omega"] - x.omega) <= printed);
  }
}

TEST_CASE("DifferentialDrive moves along its heading, counter-clockwise when the right wheel is faster") {
  Device d("DifferentialDrive",
           {{"wheel_diameter", 0.1}, {"track_width", 0.25}, {"initial_x", 2.0}, {"initial_theta", 0.5}});
  CHECK(d["pose"] == 2.0);
  CHECK(d.bench().spec().port("pose")->elements == std::vector<std::string>{"x", "y", "theta"});
  d["right"] = 6.0, d["left"] = 4.0;
  d.update();
  // v = 0.25 and omega = 0.4, each with at most three roundings
  const double roundings = 3 * 0x1p-53;
  CHECK(std::fabs(d.rate("x") - 0.25 * std::cos(0.5)) <= roundings);
  CHECK(std::fabs(d.rate("y") - 0.25 * std::sin(0.5)) <= roundings);
  CHECK(std::fabs(d.rate("theta") - 0.4) <= roundings);
}

TEST_CASE("MecanumInverse turns motions into wheel speeds") {
  Device d("MecanumInverse");
  check_inverse(d, {0.45, 0.0, 0.0}, {9.0, 9.0, 9.0, 9.0}, rounding);
  check_inverse(d, {0.0, 0.3, 0.0}, {6.0, -6.0, 6.0, -6.0}, rounding);
  check_inverse(d, {0.0, 0.0, 1.0}, {9.0, -9.0, -9.0, 9.0}, rounding);
  check_inverse(d, {0.45, -0.3, 1.0}, {12.0, 6.0, -6.0, 24.0}, rounding);
  check_inverse(d, from_paper({0.3, 0.1, 0.5}), {0.5, 3.5, -8.5, 12.5}, rounding);
}

TEST_CASE("MecanumInverse slows a motion down as a whole when a wheel would be too fast") {
  Device d("MecanumInverse", {{"limit", 15.0}});
  check_inverse(d, {0.45, -0.3, 1.0}, {7.5, 3.75, -3.75, 15.0}, rounding);
  CHECK(std::fabs(d["scale"] - 0.625) <= 4 * 0x1p-53);
  check_inverse(d, {-0.45, 0.3, -1.0}, {-7.5, -3.75, 3.75, -15.0}, rounding);
  check_inverse(d, {0.45, 0.0, 0.0}, {9.0, 9.0, 9.0, 9.0}, rounding);
  CHECK(d["scale"] == 1.0);
}

TEST_CASE("MecanumInverse with rollers at 60 degrees") {
  Device d("MecanumInverse", {{"roller_angle", 60.0 * degree}});
  check_inverse(d, from_paper({0.3, 0.1, 0.5}), {1.979274058, 2.020725942, -4.907477288, 8.907477288},
                printed);
}

TEST_CASE("MecanumDrive finds the motion that fits its wheels best, and what does not fit") {
  Device d("MecanumDrive");
  check_forward(d, {0.5, 3.5, -8.5, 12.5}, from_paper({0.3, 0.1, 0.5}), 0.0, rounding);
  check_forward(d, {10.0, 8.0, 9.0, 11.0}, from_paper({0.0, 0.475, 0.111111111}), -0.5, printed);
}

TEST_CASE("What MecanumInverse asks for is what MecanumDrive does, and the rest is slip") {
  for (const double angle : {30.0, 45.0, 70.0}) {
    const Keys keys{{"roller_angle", angle * degree}, {"half_track", 0.3}, {"half_wheelbase", 0.1}};
    Device inverse("MecanumInverse", keys), drive("MecanumDrive", keys);
    const Motion motion{0.4, -0.2, 0.7};
    for (int k = 0; k < 3; ++k) inverse[motions[k]] = motion[k];
    inverse.update();
    Wheels speeds{};
    const double e = 0.25;
    for (int k = 0; k < 4; ++k) speeds[k] = inverse[wheels[k]] + (k < 2 ? e : -e);
    check_forward(drive, speeds, motion, e, rounding);
  }
}

TEST_CASE("MecanumDrive moves in its own frame, sideways less by the lateral slip") {
  Device d("MecanumDrive", {{"initial_theta", 0.5}, {"lateral_slip", 0.25}});
  const Wheels speeds{12.0, 6.0, -6.0, 24.0};  // vx 0.45, vy -0.3, omega 1
  for (int k = 0; k < 4; ++k) d[wheels[k]] = speeds[k];
  d.update();
  CHECK(std::fabs(d["vy"] + 0.3) <= rounding);
  CHECK(std::fabs(d.rate("x") - (0.45 * std::cos(0.5) + 0.225 * std::sin(0.5))) <= rounding);
  CHECK(std::fabs(d.rate("y") - (0.45 * std::sin(0.5) - 0.225 * std::cos(0.5))) <= rounding);
  CHECK(std::fabs(d.rate("theta") - 1.0) <= rounding);
}

TEST_CASE("Unicycle moves along its heading and turns counter-clockwise") {
  Device d("Unicycle", {{"initial_x", 2.0}, {"initial_theta", 0.5}});
  CHECK(d["pose"] == 2.0);
  d["v"] = 0.25, d["omega"] = 0.4;
  d.update();
  CHECK(d.rate("x") == 0.25 * std::cos(opaque(0.5)));
  CHECK(d.rate("y") == 0.25 * std::sin(opaque(0.5)));
  CHECK(d.rate("theta") == 0.4);
}

}  // namespace flyball::test
