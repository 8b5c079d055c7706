// What a study file says, as the rest of the program sees it.
#include "studies/file.h"
#include "tests/studies/study_text.h"

using namespace flyball;
using test::servo_study;
using test::study_of;

namespace {

double number(const Setting& setting) { return std::get<double>(setting.value); }
std::string text(const Setting& setting) { return std::get<std::string>(setting.value); }

}  // namespace

TEST_CASE("a study of one model, and nothing else, has one case, one scenario and one run") {
  const Study study = servo_study("title = \"A servo\"\nseed = 7\n");
  CHECK(study.title == "A servo");
  CHECK(study.seed == 7);
  REQUIRE(study.models.size() == 1);
  CHECK(study.models[0].name == "servo");
  CHECK(study.models[0].plan != nullptr);
  REQUIRE(study.cases.size() == 1);
  CHECK(study.cases[0].name == "model");
  CHECK(study.cases[0].settings.empty());
  REQUIRE(study.scenarios.size() == 1);
  CHECK(study.scenarios[0].name == "nominal");
  CHECK(study.sweep.points() == 1);
  CHECK(study.monte_carlo.runs == 1);
}

TEST_CASE("values are numbers in SI where the model has a slot for them") {
  const Study study = servo_study(R"toml(
[cases]
plain = { Kp = 4, Ki = "2000 mV/s" }
blocks = { "sensor.deviation" = "1 deg", controller.upper = "0.01 kV" }
)toml");
  REQUIRE(study.cases.size() == 2);
  REQUIRE(study.cases[0].settings.size() == 2);
  CHECK(study.cases[0].settings[0].name == "Kp");
  CHECK(number(study.cases[0].settings[0]) == 4.0);
  CHECK(number(study.cases[0].settings[1]) == 2.0);
  REQUIRE(study.cases[1].settings.size() == 2);
  CHECK(number(study.cases[1].settings[0]) == 1.0 * (M_PI / 180.0));
  CHECK(study.cases[1].settings[1].name == "controller.upper");
  CHECK(number(study.cases[1].settings[1]) == 10.0);
}

TEST_CASE("modes, structure, formulas and computed parameters stay texts") {
  const Study study = servo_study(R"toml(
[cases]
mode = { "controller.anti_windup" = "back_calculation", "controller.Tt" = "20 ms" }
times = { Ts = "1/3 s" }
formula = { Kp = "2 V*T/(1 s)" }
computed = { half = "0.5 s" }
flag = { "controller.setpoint_weights" = false }
solver = { simulation = { method = "rk4", rtol = 1e-3, stop = "1 min", log_interval = "1/60 s" } }
)toml");
  CHECK(text(study.cases[0].settings[0]) == "back_calculation");
  CHECK(text(study.cases[0].settings[1]) == "20 ms");
  CHECK(text(study.cases[1].settings[0]) == "1/3 s");
  CHECK(text(study.cases[2].settings[0]) == "2 V*T/(1 s)");
  CHECK(text(study.cases[3].settings[0]) == "0.5 s");
  CHECK(text(study.cases[4].settings[0]) == "false");
  const std::vector<Setting>& solver = study.cases[5].settings;
  REQUIRE(solver.size() == 4);
  CHECK(solver[0] == Setting{"simulation.method", "rk4"});
  CHECK(number(solver[1]) == 1e-3);
  CHECK(number(solver[2]) == 60.0);
  CHECK(number(solver[3]) == 1.0 / 60.0);
}

TEST_CASE("axes of a sweep are lists, ranges and logarithmic ranges") {
  const Study study = servo_study(R"toml(
[sweep]
Kp = ["1 V", 2, "3 V"]
Ki = { from = 1.0, to = 2.0, points = 5 }
T = { from = "10 ms", to = "1 s", points = 3, scale = "log" }
K = { from = 3, to = 1, step = -0.5 }
Ts = { from = "1 ms", to = "3 ms", step = "1 ms" }
"controller.anti_windup" = ["none", "clamping"]
)toml");
  const auto& axes = study.sweep.axes;
  REQUIRE(axes.size() == 6);
  using Values = std::vector<std::variant<double, std::string>>;
  CHECK(axes[0].values == Values{1.0, 2.0, 3.0});
  CHECK(axes[1].values == Values{1.0, 1.25, 1.5, 1.75, 2.0});
  REQUIRE(axes[2].values.size() == 3);
  CHECK(std::get<double>(axes[2].values[0]) == 0.01);
  // The middle is the geometric mean, 0.1, but for the rounding of pow.
  CHECK(std::get<double>(axes[2].values[1]) == Approx(0.1).epsilon(1e-15));
  CHECK(std::get<double>(axes[2].values[2]) == 1.0);
  CHECK(axes[3].values == Values{3.0, 2.5, 2.0, 1.5, 1.0});
  CHECK(axes[4].values == Values{"1/1000", "1/500", "3/1000"});
  CHECK(axes[5].values == Values{"none", "clamping"});
  CHECK_FALSE(study.sweep.zipped);
  CHECK(study.sweep.points() == 3 * 5 * 3 * 5 * 3 * 2);
}

TEST_CASE("distributions are read with the dimension of their parameter") {
  const Study study = servo_study(R"toml(
[monte_carlo]
runs = 100
sampling = "sobol"
Kp = { normal = ["2 V", "100 mV"], within = ["1 V", "3 V"] }
Ki = { uniform = [0.5, 1.5] }
T = { lognormal = ["500 ms", 1.2] }
K = { triangular = [2, 3, 5] }
sensor.deviation = { choice = [0.0, "1 deg"] }
)toml");
  CHECK(study.monte_carlo.runs == 100);
  CHECK(study.monte_carlo.sampling == MonteCarlo::Sampling::sobol);
  const auto& spread = study.monte_carlo.spread;
  REQUIRE(spread.size() == 5);
  CHECK(spread[0].second.kind == Distribution::Kind::normal);
  CHECK(spread[0].second.b == 0.1);
  CHECK(spread[0].second.highest == 3.0);
  CHECK(spread[2].second.a == 0.5);
  CHECK(spread[3].second.c == 3.0);
  CHECK(spread[4].first == "sensor.deviation");
  CHECK(spread[4].second.values.size() == 2);
}

TEST_CASE("several models go by the stems of their files, or by the names of a table") {
  const Study list = study_of(R"toml(
flyball = 1
study.models = ["parts/servo.toml", "parts/drive.toml"]
[cases]
soft = { Kp = "1 V" }
)toml");
  REQUIRE(list.models.size() == 2);
  CHECK(list.models[0].name == "servo");
  CHECK(list.models[1].name == "drive");
  CHECK(number(list.cases[0].settings[0]) == 1.0);
  const Study table =
      study_of("flyball = 1\nstudy.models = { a = \"parts/servo.toml\", b = \"parts/servo.toml\" }\n");
  CHECK(table.models[1].name == "b");
}

TEST_CASE("a file with a section [study] is a study") {
  CHECK(is_study("flyball = 1\n[study]\nmodel = 3\n"));
  CHECK(is_study("study.model = \"m.toml\""));
  CHECK_FALSE(is_study("flyball = 1\n[blocks]\nstudy = { type = \"Constant\" }\n"));
  CHECK_FALSE(is_study("[study"));
}

TEST_CASE("shipped studies are in order") {
  const auto folder = std::filesystem::path(source_dir()) / "studies";
  int studies = 0;
  for (const auto& domain : std::filesystem::directory_iterator(folder)) {
    if (!domain.is_directory()) continue;
    for (const auto& entry : std::filesystem::directory_iterator(domain)) {
      if (entry.path().extension() != ".toml") continue;
      Diagnostics diagnostics(entry.path().string());
      CHECK(read_study(read_file(entry.path()), diagnostics).has_value());
      for (const Diagnostic& diagnostic : diagnostics.sorted()) UNSCOPED_INFO(to_string(diagnostic));
      CHECK_FALSE(diagnostics.failed());
      ++studies;
    }
  }
  CHECK(studies >= 6);
}
