// Lines, arcs, controllers and allocation. Ma et al. 2018 count headings from +y: theirs and 90 deg are ours.
// Lengths are in mm, as printed.
#include <cmath>

#include "blocks/se2.h"
#include "tests/blocks/bench.h"
#include "tests/catch.h"

namespace flyball::test {
namespace {

using namespace std::string_literals;

constexpr double from_y = M_PI_2;

void place(Device& d, double x, double y, double theta) {
  d["pose.x"] = x, d["pose.y"] = y, d["pose.theta"] = theta;
}

Device line(const std::string& law, const Point<double>& from, const Point<double>& to) {
  Keys keys{{"law", law}, {"x1", from.x}, {"y1", from.y}, {"x2", to.x}, {"y2", to.y}, {"tolerance", 5.0}};
  if (law == "improved") keys.insert({"approach_distance", 200.0});
  return sampled("LineNavigation", keys);
}

Device arc(const std::string& law, const Point<double>& centre, double radius) {
  Keys keys{{"law", law}, {"centre_x", centre.x}, {"centre_y", centre.y}, {"radius", radius}};
  if (law == "improved") keys.insert({"approach_distance", 200.0});
  return sampled("ArcNavigation", keys);
}

}  // namespace

TEST_CASE("LineNavigation, improved: the published deviations") {
  struct Vector {
    Point<double> from, to;
    double x, y, theta, H, gamma;
  };
  for (const Vector& k : {Vector{{0, 0}, {0, 2000}, 30, 500, 0.05, 30.0, 0.100568272777},
                          Vector{{0, 0}, {1000, 1000}, 300, 500, -0.4, -141.421356237, -1.170796326795},
                          Vector{{0, 2000}, {0, 0}, -20, 500, M_PI - 0.1, 20.0, 0.200167421162}}) {
    Device d = line("improved", k.from, k.to);
    place(d, k.x, k.y, k.theta + from_y);
    d.hit("gamma");
    CHECK(std::fabs(d["H"] - k.H) <= 0.5e-9);
    // Twelve digits, and a few roundings of angles below 5 rad.
    CHECK(std::fabs(d["gamma"] - k.gamma) <= 0.5e-12 + 8 * 0x1p-53);
  }
}

TEST_CASE("LineNavigation, improved: far away it heads for the line at a right angle") {
  Device d = line("improved", {0, 0}, {0, 2000});
  for (const double off : {200.0, 5000.0}) {
    place(d, off, 300.0, from_y + M_PI_2);  // to the left, towards the line
    d.hit("gamma");
    CHECK(std::fabs(d["gamma"]) <= 0x1p-51);
    CHECK(d["heading_error"] == Approx(-M_PI_2));
  }
}

TEST_CASE("LineNavigation, old: minus the published bearings of the target") {
  struct Vector {
    Point<double> target;
    double theta, bearing;
  };
  for (const Vector& k : {Vector{{100, 2000}, 0.0, 0.049958395722}, Vector{{-100, -50}, 0.2, -1.834443935796},
                          Vector{{0, 100}, 0.0, 0.0}}) {
    Device d = line("old", {1.0, 1.0}, k.target);
    place(d, 0.0, 0.0, k.theta + from_y);
    d.hit("gamma");
    CHECK(std::fabs(d["gamma"] + k.bearing) <= 0.5e-12 + 8 * 0x1p-53);
  }
}

TEST_CASE("LineNavigation, old: within the tolerance of its target it keeps the last deviation") {
  Device d = line("old", {0, 0}, {0, 2000});
  place(d, 4.0, 1996.0, from_y);
  const double last = d.hit("gamma");
  CHECK(last == Approx(std::atan2(4.0, 4.0)));
  CHECK(d["arrived"] == 0.0);
  place(d, 4.0, 1997.0, from_y);  // at exactly 5 mm
  CHECK(d.hit("gamma") == last);
  CHECK(d["arrived"] == 1.0);
  place(d, 0.0, 2000.0, from_y);
  CHECK(d.hit("gamma") == last);
  CHECK(d["distance"] == 0.0);
}

TEST_CASE("ArcNavigation, improved: the published deviations on both sides") {
  for (const double side : {1.0, -1.0}) {
    Device d = arc("improved", {side * 1000.0, 0.0}, side * 1000.0);
    place(d, 10.0, 0.0, 0.05 + from_y);
    d.hit("gamma");
    // On the right-hand circle the robot is inside, on the left-hand one outside: to the right of both.
    CHECK(std::fabs(d["H"] - 10.0) <= 4 * 1000 * 0x1p-53);
    CHECK(std::fabs(d["gamma"] - 2.0856806e-5) <= 0.5e-12 + 8 * 0x1p-53);
    CHECK(d["curvature"] == side / 1000.0);
    place(d, 0.0, 0.0, from_y);
    d.hit("gamma");
    CHECK(std::fabs(d["H"]) <= 4 * 1000 * 0x1p-53);
    CHECK(std::fabs(d["gamma"]) <= 8 * 0x1p-53);
  }
}

TEST_CASE("ArcNavigation, old: the published heading errors on both sides") {
  for (const double side : {1.0, -1.0}) {
    Device d = arc("old", {side * 1000.0, 0.0}, side * 1000.0);
    for (const double theta : {0.05, -0.1}) {
      place(d, 10.0, 0.0, theta + from_y);
      d.hit("gamma");
      CHECK(std::fabs(d["gamma"] + theta) <= 8 * 0x1p-53);
    }
  }
}

TEST_CASE("ArcNavigation keeps its heading error at the centre, where the tangent is unknown") {
  for (const double side : {1.0, -1.0}) {
    Device d = arc("improved", {side * 1000.0, 0.0}, side * 1000.0);
    place(d, side * 1000.0, 0.0, from_y);
    d.hit("gamma");
    CHECK(d["heading_error"] == 0.0);
    CHECK(d["H"] == side * 1000.0);
    CHECK(d["gamma"] == side * M_PI_2);
    place(d, side * 900.0, 0.0, from_y + 0.3);
    const double last = d.hit("heading_error");
    place(d, side * 1000.0, 0.0, from_y + 2.0);
    CHECK(d.hit("heading_error") == last);
  }
}

TEST_CASE("DeviationPID: the published efforts with the sum, and as printed") {
  const auto efforts = [](const char* integral) {
    Device d =
        sampled("DeviationPID", {{"integral", std::string(integral)}, {"P", 2.0}, {"D", 0.5}, {"I", 0.1}});
    std::vector<double> u;
    for (const double e : {0.10, 0.08, 0.05}) {
      d["e"] = e;
      u.push_back(d.hit("u"));
    }
    return u;
  };
  const auto check = [](const std::vector<double>& u, const std::vector<double>& expected) {
    for (std::size_t k = 0; k < 3; ++k) CHECK(std::fabs(u[k] - expected[k]) <= 4 * 0x1p-54);
  };
  check(efforts("sum"), {0.21, 0.168, 0.108});
  check(efforts("printed"), {0.21, 0.158, 0.09});
}

TEST_CASE("DeviationPID keeps its sum and its output within their limits") {
  Device d = sampled("DeviationPID", {{"P", 1.0}, {"I", 1.0}, {"sum_limit", 2.0}, {"limit", 3.5}});
  d["e"] = 1.0;
  CHECK((d.hit("u") == 2.0 && d.hit("u") == 3.0 && d.hit("u") == 3.0));
  d["e"] = 9.0;
  CHECK(d.hit("u") == 3.5);
  d["e"] = -1.0;
  CHECK(d.hit("u") == 0.0);  // the sum left its limit at once: -1 + (2 - 1)
}

TEST_CASE("WheelSpeedAllocation: the published wheel speeds") {
  Device d("WheelSpeedAllocation", {{"track_width", 300.0}, {"limit", 1.0}});
  d["v"] = 500.0;
  struct Vector {
    double curvature, U, right, left;
  };
  for (const Vector& k :
       {Vector{1e-3, -0.1, 475.0, 525.0}, Vector{-1e-3, 0.02, 565.0, 435.0}, Vector{0.0, 0.05, 475.0, 525.0},
        Vector{0.0, 3.0, 0.0, 1000.0}, Vector{0.0, -3.0, 1000.0, 0.0}}) {
    d["curvature"] = k.curvature, d["U"] = k.U;
    d.update();
    CHECK(d["right"] == Approx(k.right).epsilon(1e-15));
    CHECK(d["left"] == Approx(k.left).epsilon(1e-15));
  }
}

TEST_CASE("PathSequencer goes from part to part as the robot passes their ends") {
  Device d = sampled("PathSequencer", {{"parts", 3.0},
                                       {"end_x", Numbers{2.0, 3.0, 3.0}},
                                       {"end_y", Numbers{0.0, -1.0, -4.0}},
                                       {"end_theta", Numbers{0.0, -M_PI_2, -M_PI_2}},
                                       {"curvature", Numbers{0.0, 1.0, 0.0}}});
  for (int k = 1; k <= 3; ++k) {
    d["gamma" + std::to_string(k)] = 0.1 * k;
    d["H" + std::to_string(k)] = 1.0 * k;
  }
  const auto part = [&](double x, double y) {
    place(d, x, y, 0.0);
    return d.hit("part");
  };
  CHECK(part(1.9, 0.1) == 1.0);
  CHECK((d["gamma"] == 0.1 && d["H"] == 1.0 && d["curvature"] == 0.0 && d["done"] == 0.0));
  CHECK(part(2.0, 0.1) == 2.0);  // on the line across its end
  CHECK((d["gamma"] == 0.2 && d["H"] == 2.0 && d["curvature"] == 1.0));
  CHECK(part(1.5, 0.1) == 2.0);   // there is no way back
  CHECK(part(5.0, -1.5) == 2.0);  // past its end, but far away
  CHECK(part(3.0, -1.1) == 3.0);
  CHECK((d["gamma"] == 0.1 * 3 && d["curvature"] == 0.0));
  CHECK(part(3.0, -4.0) == 4.0);
  CHECK((d["gamma"] == 0.1 * 3 && d["done"] == 1.0));
}

TEST_CASE("PathSequencer passes over parts that end where it is") {
  Device d = sampled("PathSequencer", {{"parts", 3.0},
                                       {"end_x", Numbers{1.0, 1.05, 9.0}},
                                       {"end_y", Numbers{0.0, 0.0, 0.0}},
                                       {"end_theta", Numbers{0.0, 0.0, 0.0}},
                                       {"curvature", Numbers{0.0, 0.0, 0.0}}});
  place(d, 1.1, 0.0, 0.0);
  CHECK(d.hit("part") == 3.0);
}

TEST_CASE("PurePursuit drives along the arc that goes through the point aimed at") {
  Device d = sampled("PurePursuit", {{"lookahead", 0.5}});
  d["H"] = 0.1, d["heading_error"] = 0.2, d["path_curvature"] = 0.6;
  d.update();
  const double curvature = -d["curvature"];  // to the left
  // The robot starts at (0, -0.1), 0.2 rad to the right of the path, which bends to the right.
  const Pose<double> aim = moved<double>({0.0, 0.0, 0.0}, {0.5, 0.0, -0.6 * 0.5});
  const Point<double> centre{0.0 - std::sin(-0.2) / curvature, -0.1 + std::cos(-0.2) / curvature};
  CHECK(std::hypot(aim.x - centre.x, aim.y - centre.y) == Approx(1.0 / std::fabs(curvature)).epsilon(1e-13));
}

TEST_CASE("PurePursuit on its path drives the curvature of the path") {
  Device d = sampled("PurePursuit");
  for (const double bend : {0.0, 0.8, -2.0}) {
    d["path_curvature"] = bend;
    d.update();
    CHECK(d["curvature"] == Approx(bend).margin(1e-15));
  }
}

TEST_CASE("Stanley: its steering law, its limit, and the curvature of its path") {
  Device d = sampled("Stanley", {{"gain", 3.0}, {"wheelbase", 0.25}, {"limit", 0.6}});
  d["v"] = 0.5, d["H"] = 0.02, d["heading_error"] = 0.1, d["path_curvature"] = 0.0;
  d.update();
  const double front = 0.02 + 0.25 * std::sin(0.1);
  CHECK(d["steer"] == Approx(-0.1 - std::atan(3.0 * front / 0.5)).epsilon(1e-15));
  CHECK(d["curvature"] == Approx(std::tan(d["steer"]) / 0.25).epsilon(1e-15));
  d["H"] = -5.0;
  d.update();
  CHECK(d["steer"] == 0.6);
  d["H"] = 0.0, d["heading_error"] = 0.0, d["path_curvature"] = -0.7;
  d.update();
  CHECK(d["curvature"] == Approx(-0.7).epsilon(1e-14));
}

}  // namespace flyball::test
