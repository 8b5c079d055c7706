#include "studies/result_check.h"

#include "blocks/hash.h"
#include "studies/file.h"
#include "studies/result.h"
#include "tests/catch.h"
#include "tests/studies/temporary_folder.h"

using namespace flyball;
using flyball::test::TemporaryFolder;

namespace {

constexpr std::string_view decay = R"toml(flyball = 1
[blocks]
x = { type = "Integrator", initial = 1.0 }
k = { type = "Gain", gain = -1.0 }
[diagram]
wires = ["x -> k -> x"]
log = ["x", "k"]
[simulation]
stop = "1 s"
log_interval = "0.1 s"
)toml";

RunResult run() {
  Diagnostics diagnostics("decay.toml");
  auto diagram = read_diagram(decay, diagnostics, {});
  REQUIRE(diagram);
  const auto plan = make_plan(std::make_shared<const Diagram>(*std::move(diagram)), diagnostics);
  return run_plan(plan, plan->diagram->simulation);
}

/// A result in the files' own names, as they are written.
ResultText written() {
  const TemporaryFolder folder;
  write_result(run(), {"decay.toml", std::string(decay), {}}, folder / "a.csv");
  return {"a.csv", read_file(folder / "a.csv"), "a.json", read_file(folder / "a.json")};
}

/// A result whose CSV text is another one, and whose metadata know of it: what is wrong with it shows.
ResultText sealed(std::string csv) {
  const std::string json = metadata_json(run(), {"decay.toml", std::string(decay), {}}, "a.csv", csv);
  return {"a.csv", std::move(csv), "a.json", json};
}

std::vector<std::string> problems(const ResultText& result) {
  const ResultCheck check = check_result(result);
  std::vector<std::string> texts;
  for (const Diagnostic& diagnostic : check.diagnostics) texts.push_back(to_string(diagnostic));
  CHECK(check.ok() == texts.empty());
  return texts;
}

using Problems = std::vector<std::string>;

}  // namespace

TEST_CASE("Result check: what was written is in order") {
  const ResultCheck check = check_result(written());
  CHECK(check.ok());
  CHECK(check.file == "a.csv");
  CHECK(check.rows == 11);
  CHECK(check.columns == 3);
}

TEST_CASE("Result check: 10 000 single bits that flip are all found") {
  ResultText result = written();
  const std::size_t bits = 8 * (result.csv.size() + result.json.size());
  REQUIRE(bits >= 10000);
  int refused = 0;
  for (std::size_t flip = 0; flip < 10000; ++flip) {
    // Spread evenly over both files.
    const std::size_t bit = flip * bits / 10000, byte = bit / 8;
    char& changed = byte < result.csv.size() ? result.csv[byte] : result.json[byte - result.csv.size()];
    changed ^= static_cast<char>(1 << bit % 8);
    if (!check_result(result).ok()) ++refused;
    changed ^= static_cast<char>(1 << bit % 8);
  }
  CHECK(refused == 10000);
  CHECK(check_result(result).ok());
}

TEST_CASE("Result check: a file that ends early is refused, wherever it ends") {
  const ResultText whole = written();
  for (std::size_t size = 0; size < whole.csv.size(); ++size) {
    ResultText cut = whole;
    cut.csv.resize(size);
    INFO("CSV file of " << size << " bytes");
    CHECK_FALSE(check_result(cut).ok());
  }
  for (std::size_t size = 0; size < whole.json.size(); ++size) {
    ResultText cut = whole;
    cut.json.resize(size);
    INFO("metadata of " << size << " bytes");
    CHECK_FALSE(check_result(cut).ok());
  }
}

TEST_CASE("Result check: it says what was expected and what was found, and where") {
  const ResultText whole = written();
  const std::string expected = fingerprint(whole.csv);
  const auto changed = [&](const std::string& csv) {
    return "a.csv: error: changed or truncated: expected the checksum " + expected + ", found " +
           fingerprint(csv);
  };
  ResultText result = whole;
  result.csv.resize(result.csv.rfind("0.5,"));
  CHECK(problems(result) ==
        Problems{changed(result.csv), "a.csv:7:1: error: the file ends after 5 of 11 rows"});

  result.csv = whole.csv + "2,0,0\n";
  CHECK(problems(result) ==
        Problems{changed(result.csv),
                 "a.csv:13:1: error: expected the end of the file after 11 rows, found 12"});

  result.csv = whole.csv;
  result.csv.replace(result.csv.find("\n0.3,") + 1, 3, "oh!");
  CHECK(problems(result) ==
        Problems{changed(result.csv), "a.csv:5:1: error: expected a number, found \"oh!\""});

  result = whole;
  result.json.replace(result.json.find("finished"), 8, "finishes");
  REQUIRE(problems(result).size() == 1);
  CHECK_THAT(problems(result)[0],
             Catch::StartsWith("a.json: error: changed or truncated: its text has the checksum "
                               "fnv1a64:"));
  result.json = "{}";
  CHECK(problems(result) ==
        Problems{
            "a.json: error: truncated, or not the metadata of a result: there is no \"metadata_checksum\""});
}

TEST_CASE("Result check: header, numbers and times are looked at even where the checksum is right") {
  const std::string csv = written().csv;
  const auto with = [&](std::string_view from, std::string_view to) {
    std::string changed = csv;
    return problems(sealed(changed.replace(changed.find(from), from.size(), to)));
  };
  CHECK(with("time,x,k", "time,y,k") ==
        Problems{"a.csv:1:1: error: expected the columns time,x,k, found time,y,k"});
  CHECK(with("\n0.5,", "\n0.35,") == Problems{"a.csv:7:1: error: time falls from 0.4 s to 0.35 s"});
  CHECK(with("\n0.5,", "\ninf,") == Problems{"a.csv:7:1: error: expected a finite number, found inf"});
  CHECK(with("\n0,1,-1\n", "\n0,1,-1,0\n") ==
        Problems{"a.csv:2:8: error: expected 3 numbers, one for each column of the header, found 4"});
}

TEST_CASE("Result check: a missing file is named") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(check_result(folder / "a.csv"), Catch::Contains("a.csv: cannot be read: No such file"));
  write_file(folder / "a.csv", "time\n0\n");
  CHECK_THROWS_WITH(check_result(folder / "a.csv"), Catch::Contains("a.json: cannot be read: No such file"));
}
