#include "studies/result.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "blocks/hash.h"
#include "studies/file.h"
#include "tests/catch.h"
#include "tests/studies/temporary_folder.h"

using namespace flyball;
using flyball::test::TemporaryFolder;

namespace {

/// x' = -x from x = 1, and the integral of the root of x - limit, which fails where x goes below the limit.
constexpr std::string_view decay = R"toml(flyball = 1
[model]
title = "Decay"
[parameters]
limit = 0.0
[blocks]
x = { type = "Integrator", initial = 1.0 }
k = { type = "Gain", gain = -1.0 }
r = { type = "Expression", formula = "sqrt(u - limit)" }
s = { type = "Integrator" }
[diagram]
wires = ["x -> k -> x", "x -> r -> s"]
log = ["x", "r"]
[simulation]
stop = "1 s"
log_interval = "0.1 s"
)toml";

std::shared_ptr<const Plan> plan_of(const std::vector<Override>& overrides) {
  Diagnostics diagnostics("decay.toml");
  auto diagram = read_diagram(decay, diagnostics, overrides);
  std::string errors;
  for (const Diagnostic& d : diagnostics.sorted()) errors += to_string(d) + '\n';
  INFO(errors);
  REQUIRE(diagram);
  return make_plan(std::make_shared<const Diagram>(*std::move(diagram)), diagnostics);
}

RunResult run(const std::vector<Override>& overrides, const std::function<bool(double)>& progress = {}) {
  const auto plan = plan_of(overrides);
  return run_plan(plan, plan->diagram->simulation, {}, progress);
}

}  // namespace

TEST_CASE("Hash: FNV-1a has its published values") {
  CHECK(fnv1a("") == 0xcbf29ce484222325);
  CHECK(fnv1a("a") == 0xaf63dc4c8601ec8c);
  CHECK(fnv1a("foobar") == 0x85944171f73967e8);
  CHECK(fingerprint("a") == "fnv1a64:af63dc4c8601ec8c");
}

TEST_CASE("Result: the sidecar says what the rows are, where they came from and how they were made") {
  const TemporaryFolder folder;
  const std::vector<Override> overrides{{"k.gain", "-2"}};
  const RunResult result = run(overrides);
  const ResultFiles written =
      write_result(result, {"decay.toml", std::string(decay), overrides}, folder / "a.csv");
  CHECK(written.warnings.empty());
  CHECK(written.files.size() == 5);
  CHECK(folder.files() == 5);

  const std::string csv = read_file(folder / "a.csv");
  const auto json = nlohmann::json::parse(read_file(folder / "a.json"));
  CHECK(json["status"] == "finished");
  CHECK(json["rows"] == 11);
  CHECK(std::ranges::count(csv, '\n') == 12);
  CHECK(json["csv"]["file"] == "a.csv");
  CHECK(json["csv"]["checksum"] == fingerprint(csv));
  const RunInputs inputs{"decay.toml", std::string(decay), overrides};
  CHECK_FALSE(nlohmann::json::parse(metadata_json(result, inputs)).contains("csv"));
  // Another run takes another time, and says the same.
  CHECK(metadata_json(run(overrides), inputs, "a.csv", csv) == read_file(folder / "a.json"));
  CHECK(json["columns"][1]["unit"] == "");
  CHECK(json["model"]["hash"] == fingerprint(decay));
  CHECK(json["model"]["set"]["k.gain"] == "-2");
  CHECK(json["columns"][0]["unit"] == "s");
  CHECK(json["columns"][1]["name"] == "x");
  CHECK(json["solver"]["statistics"]["steps"].get<long>() > 0);
  // A thousand times rtol = 1e-6: the global error of a decay is below the sum of the local ones.
  CHECK(json["last_row"]["x"].get<double>() == Approx(std::exp(-2.0)).epsilon(1e-3));
  CHECK(json["libraries"]["sundials"].get<std::string>().substr(0, 1) >= "6");
}

TEST_CASE("Result: the hash of a model covers the files that it uses") {
  RunResult result = run({});
  const RunInputs inputs{"decay.toml", std::string(decay), {}};
  const auto model_of = [&](const std::vector<UsedFile>& used) {
    Diagram diagram = *result.plan->diagram;
    diagram.used_files = used;
    auto plan = std::make_shared<Plan>(*result.plan);
    plan->diagram = std::make_shared<const Diagram>(std::move(diagram));
    result.plan = plan;
    return nlohmann::json::parse(metadata_json(result, inputs))["model"];
  };
  const auto one = model_of({{"gain.toml", "a"}});
  CHECK(one["uses"][0]["file"] == "gain.toml");
  CHECK(one["uses"][0]["hash"] == fingerprint("a"));
  CHECK(one["hash"] != model_of({})["hash"]);
  CHECK(one["hash"] != model_of({{"gain.toml", "b"}})["hash"]);
  // Where one file ends and the next begins counts, too.
  CHECK(model_of({{"x", "ab"}, {"y", "c"}})["hash"] != model_of({{"x", "a"}, {"y", "bc"}})["hash"]);
}

TEST_CASE("Result: a run that has to stop keeps its rows and says why") {
  const RunResult result = run({{"limit", "0.5"}});
  CHECK(result.status == RunStatus::stopped);
  CHECK_THAT(result.reason, Catch::Contains("r.y"));
  // x falls to 0.5 at ln 2 = 0.693 s: rows at 0, 0.1, … 0.6 are there.
  REQUIRE(result.log.rows() >= 7);
  CHECK(result.log.time(6) == Approx(0.6));

  const TemporaryFolder folder;
  write_result(result, {"decay.toml", std::string(decay), {}}, folder / "a.csv");
  const auto json = nlohmann::json::parse(read_file(folder / "a.json"));
  CHECK(json["status"] == "stopped");
  CHECK(json["reason"] == result.reason);
  CHECK(json["rows"] == result.log.rows());
}

TEST_CASE("Result: a run that is interrupted says so") {
  const RunResult result = run({}, [](double) { return false; });
  CHECK(result.status == RunStatus::interrupted);
}
