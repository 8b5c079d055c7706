// Encoders, odometry, gyro and landmarks. Ma et al. 2018 count headings from +y: theirs and 90 deg are ours.
#include <cmath>

#include "tests/blocks/bench.h"
#include "tests/catch.h"

namespace flyball::test {
namespace {

using namespace std::string_literals;

constexpr double from_y = M_PI_2;

void check_pose(Device& d, double x, double y, double theta, double tolerance) {
  CHECK(std::fabs(d["pose.x"] - x) <= tolerance);
  CHECK(std::fabs(d["pose.y"] - y) <= tolerance);
  CHECK(std::fabs(d["pose.theta"] - theta) <= tolerance);
}

Device odometry(const std::string& heading, double x, double y, double theta) {
  return sampled("EncoderOdometry", {{"heading", heading},
                                     {"right_step", 0.05},
                                     {"left_step", 0.05},
                                     {"track_width", 300.0},
                                     {"initial_x", x},
                                     {"initial_y", y},
                                     {"initial_theta", theta}});
}

/// The numbers of an Allan deviation: half the mean square of second differences over m hits, by m^2 ts^2.
double allan_variance(const std::vector<double>& angle, std::size_t m, double ts) {
  double sum = 0.0;
  const std::size_t n = angle.size() - 2 * m;
  for (std::size_t k = 0; k < n; ++k) {
    const double second = angle[k + 2 * m] - 2.0 * angle[k + m] + angle[k];
    sum += second * second;
  }
  const double tau = static_cast<double>(m) * ts;
  return sum / (2.0 * tau * tau * static_cast<double>(n));
}

std::vector<double> readings(Keys keys, double ts, int n) {
  Device d = sampled("Gyro", std::move(keys));
  d["stream"] = 12345.0;
  d["sample_time"] = ts;
  std::vector<double> all;
  for (int k = 0; k < n; ++k) all.push_back(d.hit("heading"));
  return all;
}

}  // namespace

TEST_CASE("Encoder counts whole marks and keeps the rest") {
  Device d = sampled("Encoder", {{"counts_per_turn", 8.0}, {"initial", 1.0}});
  const double mark = 2.0 * M_PI / 8.0;
  double total = 0.0;
  for (const double marks : {0.0, 0.4, 0.9, 1.3, 4.75, 4.75, 3.5, -0.25}) {
    d["angle"] = 1.0 + marks * mark;
    total += d.hit("increment");
    CHECK(total == std::floor(marks));
    CHECK(d["residual"] == Approx(marks - std::floor(marks)).margin(1e-14));
  }
}

TEST_CASE("Encoder with fractions counts all that has turned") {
  Device d = sampled("Encoder", {{"counts_per_turn", 8.0}, {"quantised", false}});
  d["angle"] = 1.0;
  CHECK(d.hit("increment") == Approx(8.0 / (2.0 * M_PI)).epsilon(1e-15));
  CHECK(d["residual"] == 0.0);
  CHECK(d.hit("increment") == 0.0);
}

TEST_CASE("EncoderOdometry: the published positions of the wheels alone") {
  // Numbers below 300 with 12 digits behind the point, and one rounding of sines of them.
  const double printed = 0.5e-12 + 300 * 0x1p-53;
  Device arc = odometry("encoder", 0.0, 0.0, from_y);
  arc["left"] = 1000.0, arc["right"] = 1100.0;
  arc.hit("pose.x");
  check_pose(arc, -0.437489872779, 52.497569478202, from_y + 0.016666666667, printed);
  Device line = odometry("encoder", 100.0, 200.0, M_PI / 6.0 + from_y);
  line["left"] = 2000.0, line["right"] = 2000.0;
  line.hit("pose.x");
  check_pose(line, 50.0, 286.602540378444, 0.523598775598 + from_y, printed);
  Device turn = sampled(
      "EncoderOdometry",
      {{"right_step", 0.0502}, {"left_step", 0.05}, {"track_width", 300.0}, {"initial_theta", 0.3 + from_y}});
  turn["left"] = -500.0, turn["right"] = 500.0;
  turn.hit("pose.x");
  check_pose(turn, -0.018686693463, 0.046314173616, 0.467 + from_y, printed);
}

TEST_CASE("EncoderOdometry: turning on the spot and going straight are limits of the same arc") {
  Device d = odometry("encoder", 1.0, 2.0, 0.5);
  d["left"] = -300.0, d["right"] = 300.0;
  d.hit("pose.x");
  check_pose(d, 1.0, 2.0, 0.6, 2 * 0x1p-53);
  Device almost = odometry("encoder", 0.0, 0.0, 0.0), straight = odometry("encoder", 0.0, 0.0, 0.0);
  almost["left"] = 1000.0, almost["right"] = 1000.0 + 1e-6;
  straight["left"] = straight["right"] = 1000.0;
  almost.hit("pose.x");
  straight.hit("pose.x");
  CHECK(straight["pose.x"] == 50.0);
  CHECK(straight["pose.y"] == 0.0);
  // y = s d/2 with s = 50 and d = 1e-6*0.05/300.
  CHECK(almost["pose.y"] == Approx(50.0 * 1e-6 * 0.05 / 300.0 / 2.0)
                                .epsilon(1e-6));  // a rounding of 50, over their difference of 5e-8
}

TEST_CASE("EncoderOdometry with a gyro goes the way of the wheels along the mean heading") {
  Device d = odometry("gyro", 0.0, 0.0, 0.2);
  d["left"] = 1000.0, d["right"] = 1100.0, d["gyro"] = 0.3;
  d.hit("pose.x");
  check_pose(d, 52.5 * std::cos(0.25), 52.5 * std::sin(0.25), 0.3, 60 * 0x1p-53);
}

TEST_CASE("EncoderOdometry mixes turns of wheels and gyro, whose first reading is where it starts") {
  Device d = sampled("EncoderOdometry", {{"heading", "complementary"s},
                                         {"gyro_weight", 0.75},
                                         {"track_width", 0.5},
                                         {"right_step", 1.0},
                                         {"left_step", 1.0}});
  d["gyro"] = 7.0;
  d.hit("pose.x");
  CHECK(d["pose.theta"] == 0.0);
  d["gyro"] = 7.5, d["left"] = -0.0625, d["right"] = 0.0625;  // the wheels say 0.25
  d.hit("pose.x");
  CHECK(d["pose.theta"] == 0.75 * 0.5 + 0.25 * 0.25);
}

TEST_CASE("EncoderOdometry takes a position that it is given, and keeps its heading") {
  Device d = sampled("EncoderOdometry", {{"corrected", true}});
  d["left"] = d["right"] = 100.0;
  d["corrected_x"] = 3.0, d["corrected_y"] = 4.0;
  d["correct"] = 0.0;
  CHECK(d.hit("pose.x") == 100.0 * 5e-5);
  d["correct"] = 1.0;
  CHECK(d.hit("pose.x") == 3.0);
  CHECK(d["pose.y"] == 4.0);
  d["correct"] = 0.0;
  CHECK(d.hit("pose.x") == 3.0 + 100.0 * 5e-5);
}

TEST_CASE("Gyro: the published readings") {
  Device d = sampled("Gyro", {{"misalignment", 0.0095492965855}, {"scale_error", 1e-3}, {"bias", 1e-4}});
  struct Vector {
    double theta, t, reading;
  };
  for (const Vector& x : {Vector{M_PI / 2, 3.0, 1.577441771}, Vector{M_PI, 6.0, 3.154883543},
                          Vector{2 * M_PI, 12.0, 6.290668492}}) {
    d["theta"] = x.theta;
    d.time(x.t);
    d.update();
    CHECK(std::fabs(d["heading"] - x.reading) <= 0.5e-9);
  }
}

TEST_CASE("Gyro is right at the heading that it was set at, and after a whole turn") {
  Device d = sampled("Gyro", {{"misalignment", 0.01}, {"reference", 0.7}});
  d["theta"] = 0.7;
  CHECK(d.hit("heading") == 0.7);
  d["theta"] = 0.7 + M_PI;
  CHECK(d.hit("heading") == Approx(0.7 + M_PI + 0.01).epsilon(1e-15));
  d["theta"] = 0.7 + 2.0 * M_PI;
  CHECK(d.hit("heading") == Approx(0.7 + 2.0 * M_PI).epsilon(1e-15));
}

TEST_CASE("Gyro: white noise of the rate has the Allan deviation of its coefficient") {
  const double N = 0.01, ts = 0.5;
  const auto angle = readings({{"angle_random_walk", N}}, ts, 40000);
  for (const int m : {1, 4, 16, 64}) {
    INFO(m);
    // Some 40000/m independent differences: three deviations of sqrt(2/n), with room for their overlap.
    const double expected = N * N / (m * ts);
    CHECK(allan_variance(angle, m, ts) == Approx(expected).epsilon(3.0 * std::sqrt(3.0 * m / 40000.0)));
  }
}

TEST_CASE("Gyro: a bias that walks has the Allan deviation of its coefficient, at all times") {
  const double K = 0.02, ts = 0.5;
  const auto angle = readings({{"rate_random_walk", K}}, ts, 40000);
  for (const int m : {1, 2, 8, 32}) {
    INFO(m);
    const double expected = K * K * (m * ts) / 3.0;
    CHECK(allan_variance(angle, m, ts) == Approx(expected).epsilon(3.0 * std::sqrt(4.0 * m / 40000.0)));
  }
}

TEST_CASE("Gyro: noise of a reading does not add up") {
  const auto angle = readings({{"noise", 0.1}}, 0.5, 10000);
  double squares = 0.0;
  for (const double x : angle) squares += x * x / 10000.0;
  CHECK(squares == Approx(0.01).epsilon(4.0 * std::sqrt(2.0 / 10000.0)));  // four deviations
}

TEST_CASE("LandmarkSensor sees a landmark in range, from where the robot is") {
  Device d = sampled("LandmarkSensor", {{"landmark_x", 1.0}, {"landmark_y", 5.0}, {"range", 3.5}});
  d["pose.x"] = 1.0, d["pose.y"] = 2.0, d["pose.theta"] = 0.5;
  d.hit("seen");
  CHECK(d["seen"] == 1.0);
  CHECK(d["distance"] == 3.0);
  CHECK(d["bearing"] == Approx(M_PI_2 - 0.5).epsilon(1e-15));
  d["pose.y"] = 1.0;
  CHECK(d.hit("seen") == 0.0);
}

TEST_CASE("LandmarkCorrection: the published positions of its conventions") {
  const auto at = [](const char* convention, double bearing) {
    Device d("LandmarkCorrection",
             {{"convention", std::string(convention)}, {"landmark_x", 1000.0}, {"landmark_y", 2000.0}});
    d["theta"] = 0.3 + from_y;
    d["distance"] = 100.0;
    if (convention == "bearing"s) d["bearing"] = bearing;
    d.update();
    return std::pair{d["x"], d["y"]};
  };
  const auto check = [](std::pair<double, double> found, double x, double y) {
    CHECK(std::fabs(found.first - x) <= 0.5e-9);
    CHECK(std::fabs(found.second - y) <= 0.5e-9);
  };
  check(at("ahead", 0.0), 1029.552020666, 1904.466351087);
  check(at("bearing", 0.0), 1029.552020666, 1904.466351087);
  check(at("behind", 0.0), 970.447979334, 2095.533648913);
  check(at("bearing", M_PI), 970.447979334, 2095.533648913);
  check(at("printed", 0.0), 1029.552020666, 2095.533648913);
}

TEST_CASE("LandmarkCorrection finds the robot where LandmarkSensor was") {
  Device sensor = sampled("LandmarkSensor", {{"landmark_x", 0.3}, {"landmark_y", -0.8}});
  Device correction("LandmarkCorrection", {{"landmark_x", 0.3}, {"landmark_y", -0.8}});
  sensor["pose.x"] = -0.2, sensor["pose.y"] = 0.9, sensor["pose.theta"] = 2.0;
  sensor.update();
  correction["theta"] = 2.0;
  correction["distance"] = sensor["distance"];
  correction["bearing"] = sensor["bearing"];
  correction.update();
  CHECK(correction["x"] == Approx(-0.2).epsilon(1e-15));
  CHECK(correction["y"] == Approx(0.9).epsilon(1e-15));
}

}  // namespace flyball::test
