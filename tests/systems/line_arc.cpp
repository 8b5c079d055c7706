// Navigation along lines and arcs with old and improved laws (Ma, Liu, Yu, Cao 2018). Lengths in mm. The
// numbers are those of an independent program, with the plant in exact steps of 1 ms and the controller every
// 10 ms.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/source_dir.h"
#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

namespace {

using Overrides = std::vector<Override>;

constexpr double mm = 1e-3;
const Override upright{"A", "0 rad"};  // a gyro without misalignment
/// The last control instant of the first turn.
constexpr double turn_end = 12.56;

std::string model_path(const std::string& name) {
  return source_dir() + "/models/line_arc/" + name + ".toml";
}

Model line_arc(const std::string& name, const Overrides& overrides = {}) {
  return load_model(model_path(name), overrides);
}

Overrides with_law(const std::string& law, Overrides overrides) {
  overrides.push_back({"navigation.law", law});
  return overrides;
}

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double x : values) most = std::max(most, std::fabs(x));
  return most;
}

/// The text of a file in which each piece of text is replaced.
std::string replaced(const std::string& file,
                     const std::vector<std::pair<std::string, std::string>>& pieces) {
  std::stringstream stream;
  stream << std::ifstream(file).rdbuf();
  std::string text = stream.str();
  for (const auto& [old, with] : pieces) {
    std::size_t at = text.find(old);
    REQUIRE(at != std::string::npos);
    for (; at != std::string::npos; at = text.find(old, at + with.size())) text.replace(at, old.size(), with);
  }
  return text;
}

/// How a turn of the circle ends.
struct Turn {
  double deviation;   // of the robot, to the right of the circle
  double error;       // of the estimated position
  double correction;  // greatest |U|
};

Turn turn_of(const Overrides& overrides) {
  Run run(line_arc("arc_navigation", overrides));
  run.finish();
  return {run.logged("truth.H", turn_end) / mm, run.logged("error", turn_end) / mm,
          largest(run.column("wheels.correction"))};
}

}  // namespace

TEST_CASE("Arc error loop: where it ends without K_H, and far from its arc") {
  const auto end = [](const Overrides& overrides, double t) {
    Model model = line_arc("arc_error_loop", overrides);
    model.settings.stop = t;
    Run run(model);
    run.finish();
    return std::pair{run["H.x"] / mm, run["gamma.x"]};
  };
  // Half of the last digit, and some hundred tolerances of 1e-8 of a distance of up to 4 m.
  const double H = 0.5e-6 + 4e-3, gamma = 1e-6;
  // H0 + L/(2 K_gamma) Si(gamma0)
  const auto stays = end({{"K_H", "0 1/m"}, {"K_gamma", "1"}, {"gamma.initial", "0.6"}}, 40.0);
  CHECK(stays.first == Approx(138.219321).margin(1e-4));
  // The other equilibria: gamma = k pi, H = -k pi K_gamma/K_H; those of even k attract.
  const auto once = end({{"H.initial", "2 m"}}, 60.0), twice = end({{"H.initial", "4 m"}}, 60.0);
  CHECK(once.first == Approx(1570.796).margin(H));
  CHECK(once.second == Approx(-2.0 * M_PI).margin(gamma));
  CHECK(twice.first == Approx(3141.593).margin(H));
  CHECK(twice.second == Approx(-4.0 * M_PI).margin(gamma));
  const auto turned = end({{"gamma.initial", "0.3"}, {"K_gamma", "sqrt(1.2)"}}, 2.0);
  CHECK(turned.first == Approx(13.8323915).margin(1e-5));
  CHECK(turned.second == Approx(-0.03795434).margin(1e-8));
}

TEST_CASE("Arc navigation: the table of old and improved law") {
  struct Row {
    const char* name;
    Overrides overrides;
    double old_law, improved;
  };
  for (const Row& row : {
           Row{"ideal", {upright}, 0.0, 0.0},
           Row{"start inside", {upright, {"offset", "50 mm"}}, 18.905, 0.0},
           Row{"start outside of a left-hand circle",
               {upright, {"R", "-1000 mm"}, {"offset", "50 mm"}},
               20.137,
               0.0},
           Row{"gyro", {}, -14.571, -14.972},
           Row{"right motor 1 % fast", {upright, {"motor", "0.01"}}, -19.920, -0.944},
           Row{"right motor 0.4 % fast, and gyro", {{"motor", "0.004"}}, -22.592, -15.358},
       }) {
    INFO(row.name);
    // Half of the last digit, and the tolerance of some thousand steps.
    CHECK(std::fabs(turn_of(with_law("old", row.overrides)).deviation - row.old_law) < 0.01);
    CHECK(std::fabs(turn_of(row.overrides).deviation - row.improved) < 0.01);
  }
  CHECK(turn_of({upright, {"offset", "50 mm"}}).correction == Approx(0.2527).margin(0.5e-4));
}

TEST_CASE("Arc navigation: a gyro mounted askew leaves an error of pi A R/2") {
  const double A = 9.5492965855e-3;
  CHECK(M_PI * A * 1000.0 / 2.0 == Approx(15.0).margin(1e-6));
  CHECK(turn_of({}).error == Approx(15.0).margin(1e-3));
  CHECK(turn_of(with_law("old", {})).error == Approx(15.0069).margin(1e-3));
}

TEST_CASE("Arc navigation: errors of gyro and encoders") {
  const auto error = [](Overrides overrides) {
    overrides.push_back(upright);
    return turn_of(overrides).error;
  };
  // Half of the last digit that is known of each, or what is asked for.
  CHECK(error({{"bias", "10 deg/h"}}) == Approx(0.609).margin(0.01));
  CHECK(error({{"bias", "0.05 deg/s"}}) == Approx(10.95).margin(0.01));
  CHECK(error({{"scale", "0.001"}}) == Approx(6.283).margin(0.01));
  CHECK(error({{"odometry.estimate.heading", "encoder"}, {"odometry.right_error", "0.001"}}) ==
        Approx(17.73).margin(0.01));
  CHECK(error({{"odometry.right_error", "0.005"}, {"odometry.left_error", "0.005"}}) ==
        Approx(0.136).margin(0.01));
}

TEST_CASE("Arc navigation: how far the true paths of both laws are apart") {
  const auto distance = [](const Overrides& overrides, double t) {
    Run old_law(line_arc("arc_navigation", with_law("old", overrides))),
        improved(line_arc("arc_navigation", overrides));
    old_law.finish();
    improved.finish();
    return std::hypot(old_law.logged("robot.pose.x", t) - improved.logged("robot.pose.x", t),
                      old_law.logged("robot.pose.y", t) - improved.logged("robot.pose.y", t)) /
           mm;
  };
  // At a tenth, a quarter and the whole of the turn, to the nearest control instant.
  CHECK(distance({}, 1.26) == Approx(0.032).margin(0.001));
  CHECK(distance({}, 3.14) == Approx(0.48).margin(0.01));
  CHECK(distance({}, turn_end) == Approx(2.98).margin(0.01));
  CHECK(distance({{"motor", "0.0025"}}, turn_end) == Approx(19.6).margin(0.05));
}

namespace {

/// x of the robot where it passes y = 1000 mm, between rows that are 1 ms apart.
double halfway(Run& run) {
  const std::vector<double> x = run.column("robot.pose.x"), y = run.column("robot.pose.y");
  std::size_t k = 1;
  while (y.at(k) < 1.0) ++k;
  return (x[k - 1] + (1.0 - y[k - 1]) / (y[k] - y[k - 1]) * (x[k] - x[k - 1])) / mm;
}

}  // namespace

TEST_CASE("Line navigation: where old and improved law pass half of the line, and their ISE") {
  struct Row {
    const char* law;
    double x, ise;
  };
  for (const Row& row : {Row{"old", 27.198, 3807.8}, Row{"improved", -1.094, 864.2}}) {
    INFO(row.law);
    Run run(line_arc("line_navigation", with_law(row.law, {})));
    run.finish();
    CHECK(halfway(run) == Approx(row.x).margin(0.0006));  // half of the last digit
    CHECK(run.logged("ISE", 4.0) / (mm * mm) == Approx(row.ise).margin(0.06));
  }
}

TEST_CASE("Line navigation: a controller that is ever faster comes to the one in continuous time") {
  struct Row {
    const char* law;
    double x, ise;
  };
  for (const Row& row : {Row{"old", 27.238, 3814.9}, Row{"improved", -1.208, 871.9}}) {
    INFO(row.law);
    Run run(line_arc("line_navigation", with_law(row.law, {{"navigation.sample_time", "1/4 ms"},
                                                           {"pid.sample_time", "1/4 ms"}})));
    run.finish();
    // A fortieth of the difference that 10 ms make: 0.003 mm and 0.2 mm^2 s.
    CHECK(halfway(run) == Approx(row.x).margin(0.004));
    CHECK(run.logged("ISE", 4.0) / (mm * mm) == Approx(row.ise).margin(0.3));
  }
}

TEST_CASE("Line navigation: near its end the old law's correction becomes violent") {
  const auto last = [](const std::string& law) {
    Run run(line_arc("line_navigation", with_law(law, {{"motor", "0.02"}})));
    run.finish();
    const std::vector<double> y = run.column("robot.pose.y"), U = run.column("wheels.correction");
    double most = 0.0;
    for (std::size_t k = 0; k < y.size(); ++k) {
      if (y[k] > 1.9 && y[k] <= 2.0) most = std::max(most, std::fabs(U[k]));
    }
    return most;
  };
  CHECK(last("old") == Approx(0.2523).margin(0.5e-4));
  CHECK(last("improved") == Approx(0.0104).margin(0.5e-4));
}

TEST_CASE("Line navigation with lag: the improved law overshoots with a small gain, the old one never") {
  const auto overshoot = [](const Overrides& overrides) {
    Run run(line_arc("line_with_lag", overrides));
    run.finish();
    double least = 0.0;
    for (const double x : run.column("robot.pose.x")) least = std::min(least, x);
    return -least / mm;
  };
  CHECK(overshoot({{"P", "0.5"}}) == Approx(14.6).margin(0.06));
  CHECK(overshoot({{"P", "3"}}) < 1e-3);
  CHECK(overshoot({{"P", "0.5"}, {"navigation.law", "old"}}) < 1e-3);
}

TEST_CASE("Line, arc, line: nothing jumps where one part of the path goes over into the next") {
  Run run(line_arc("line_arc_line", {{"offset", "0 mm"}}));
  run.finish();
  const std::vector<double> part = run.column("course.part");
  CHECK(part.front() == 1.0);
  CHECK(part.back() == 3.0);
  // A junction is seen up to a hit, 5 mm, late. By then the heading is wrong by 5/800, which leads the robot
  // off by 0.09 m times that: the peak of the impulse response of h'' + (2/L) h' + 2/(L R0) h along the way.
  CHECK(largest(run.column("course.gamma")) < 1.05 * 5.0 / 800.0);
  CHECK(largest(run.column("course.H")) < 0.1 * 5.0 / 800.0);
}

TEST_CASE("Line, arc, line: from beside its first line the robot comes to its last one") {
  Run run(line_arc("line_arc_line"));
  run.finish();
  CHECK(run.column("course.part").back() == 3.0);
  CHECK(std::fabs(run.column("course.H").back()) < 0.1 * mm);
}

TEST_CASE("Ten laps: errors add up until a landmark ends their drift") {
  const auto errors = [](const Overrides& overrides) {
    Run run(line_arc("ten_laps", overrides));
    run.finish();
    return run.column("error");
  };
  const double lap = 15.0 * mm;  // pi A R/2
  CHECK(errors({{"correction", "0"}}).back() == Approx(10.0 * lap).epsilon(1e-3));
  const std::vector<double> corrected = errors({});
  CHECK(largest(corrected) < 1.5 * lap);
  CHECK(corrected.back() < 0.01 * mm);
  // x from a landmark ahead and y from one behind: wrong by twice the distance across.
  CHECK(largest(errors({{"landmark.convention", "printed"}})) > 10.0 * lap);
}

TEST_CASE("Ten laps: no landmark helps a heading that drifts") {
  Run run(line_arc("ten_laps", {{"A", "0 rad"}, {"scale", "0.001"}}));
  run.finish();
  // The circle is turned about the landmark, and its far side displaced by 2 R times the angle.
  const double displaced = 2.0 * 10.0 * 2.0 * M_PI / 1000.0;
  CHECK(largest(run.column("error")) == Approx(displaced).epsilon(0.05));
}

TEST_CASE("Odometry: the figure closes, and whole counts follow it to a few of them") {
  Run run(line_arc("odometry"));
  run.finish();
  // J0(z) = 0: the robot is where it began, to the errors of some thousand steps.
  CHECK(std::hypot(run.logged("robot.pose.x", 20.0), run.logged("robot.pose.y", 20.0)) < 1e-8);
  const double count = 2.0 * M_PI * 50.0 * mm / 6000.0, L = 300.0 * mm;
  double turned = 0.0;
  for (std::size_t k = 0; k < run.times().size(); k += 100) {
    turned =
        std::max(turned, std::fabs(run.column("odometry.pose.theta")[k] - run.column("robot.pose.theta")[k]));
  }
  // At rows between hits the estimate is up to 10 ms old: none of these rows is.
  CHECK(turned < 2.0 * count / L);
  Run askew(line_arc("odometry", {{"right_error", "0.001"}}));
  askew.finish();
  // The right wheel goes V T = 10 m, of which it counts a thousandth too much.
  CHECK(askew.logged("odometry.pose.theta", 20.0) == Approx(0.01 / L).margin(2.0 * count / L));
}

TEST_CASE("Exact steps of 1 ms, Dormand-Prince and CVODE drive the same line and the same circle") {
  const std::string library = "type = \"" + source_dir() + "/models/library/";
  for (const auto& [name, signal] :
       {std::pair{"arc_navigation", "truth.H"}, {"line_navigation", "robot.pose.x"}}) {
    INFO(name);
    Model model = line_arc(name, {{"offset", "50 mm"}});
    model.settings.rtol = 1e-12;
    model.settings.atol = 1e-14;
    const auto end = [&](Model of, const std::string& method) {
      of.settings.method = method;
      Run run(of);
      run.finish();
      return run.column(signal).back();
    };
    const double reference = end(model, "dp5");
    // The wheels have turned by 125 rad, of which each of some ten thousand steps may lose 1e-12: 6e-8 m of
    // way.
    for (const char* method : {"adams", "bdf"}) CHECK(end(model, method) == Approx(reference).margin(6e-8));
    const std::string exact_robot = "type = \"" + source_dir() + "/tests/systems/sampled_robot.toml";
    const std::string text = replaced(model_path(name), {{"type = \"../library/", library},
                                                         {library + "differential_robot.toml", exact_robot}});
    Model sampled = read_model(text);
    Model same = line_arc(name);
    Run exact(sampled), dp5(same);
    exact.finish();
    dp5.finish();
    CHECK(exact.column(signal).back() == Approx(dp5.column(signal).back()).margin(1e-8));
  }
}
