#include "studies/language/run_table.h"

#include <limits>
#include <map>

#include "tests/studies/study_text.h"

using namespace flyball;
using test::servo_study;

namespace {

const char* const everything = R"toml(
[cases]
soft = { Kp = "1 V" }
hard = { Kp = "9 V", T = "2 s" }
[scenarios]
nominal = {}
heavy = { T = "1 s" }
[sweep]
Ki = [1, 2, 3]
K = [4, 5]
[monte_carlo]
runs = 5
T = { normal = ["0.5 s", "10 ms"] }
)toml";

/// Where a name is set several times, the last one counts.
std::map<std::string, double> values(const RunRequest& request) {
  std::map<std::string, double> result;
  for (const Setting& setting : request.settings) result[setting.name] = std::get<double>(setting.value);
  return result;
}

}  // namespace

TEST_CASE("each run of a table has a place, the sample changes fastest") {
  const Study study = servo_study(everything);
  const RunTable table(study, study.cases);
  REQUIRE(table.size() == 2 * 2 * 6 * 5);
  CHECK(table.place(0).sample == 0);
  CHECK(table.place(4).sample == 4);
  CHECK(table.place(5).sweep == 1);
  CHECK(table.place(30).scenario == 1);
  CHECK(table.place(60).choice == 1);
  const RunPlace last = table.place(table.size() - 1);
  CHECK(last.sample == 4);
  CHECK(last.sweep == 5);
  CHECK(last.scenario == 1);
  CHECK(last.choice == 1);
}

TEST_CASE("the case wins over the scenario, this over the sample, this over the sweep") {
  const Study study = servo_study(everything);
  const RunTable table(study, study.cases);
  const auto soft_nominal = values(table.request(0));
  CHECK(soft_nominal.at("Kp") == 1.0);
  CHECK(soft_nominal.at("Ki") == 1.0);
  CHECK(soft_nominal.at("K") == 4.0);
  // 10 ms are a standard deviation; 6 of them.
  CHECK(soft_nominal.at("T") == Approx(0.5).margin(0.06));
  CHECK(values(table.request(5)).at("K") == 5.0);
  CHECK(values(table.request(10)).at("Ki") == 2.0);
  CHECK(values(table.request(30)).at("T") == 1.0);
  CHECK(values(table.request(60)).at("T") == 2.0);
}

TEST_CASE("samples are paired: the same seed and draws for every case, scenario and sweep point") {
  const Study study = servo_study(everything);
  const RunTable table(study, study.cases);
  for (std::int64_t run = 0; run < table.size(); ++run) {
    const RunRequest first = table.request(run % 5), request = table.request(run);
    CHECK(request.seed == first.seed);
    CHECK(request.settings[2] == first.settings[2]);
  }
  CHECK(table.request(0).seed == 1);
  CHECK(table.request(1).seed != table.request(2).seed);
}

TEST_CASE("zipped axes move together") {
  const Study study = servo_study("[sweep]\ncombine = \"zip\"\nKi = [1, 2, 3]\nK = [4, 5, 6]\n");
  const RunTable table(study, study.cases);
  REQUIRE(table.size() == 3);
  CHECK(values(table.request(1)).at("Ki") == 2.0);
  CHECK(values(table.request(1)).at("K") == 5.0);
}

TEST_CASE("settings of one model alone leave the others as they are") {
  const Study study =
      test::study_of("flyball = 1\nstudy.models = [\"parts/servo.toml\", \"parts/drive.toml\"]\n");
  const RunTable table(study, {{"fitted", {{"Kp", 3.0, 1}, {"T", 1.0}}, "", "", {}}});
  REQUIRE(table.size() == 2);
  CHECK(values(table.request(0)).count("Kp") == 0);
  CHECK(values(table.request(0)).at("T") == 1.0);
  CHECK(values(table.request(1)).at("Kp") == 3.0);
}
