// Each broken model NAME.toml beside this file with what is said about it, line by line, in NAME.expected.
// Files that these models use are in the folder `parts`.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "models/diagram.h"
#include "tests/catch.h"
#include "tests/source_dir.h"

using namespace flyball;
namespace fs = std::filesystem;

namespace {

const fs::path folder = fs::path(source_dir()) / "tests" / "diagnostics";

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<fs::path> models() {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".toml") found.push_back(entry.path());
  }
  std::ranges::sort(found);
  return found;
}

std::string said_about(const std::string& name, std::string_view text) {
  Diagnostics diagnostics(name);
  const auto diagram = read_diagram(text, diagnostics);
  CHECK(diagram.has_value() == !diagnostics.failed());
  std::string lines;
  for (const Diagnostic& diagnostic : diagnostics.sorted()) lines += to_string(diagnostic) + "\n";
  return lines;
}

}  // namespace

TEST_CASE("broken models are told what is wrong, line by line") {
  const auto all = models();
  REQUIRE(all.size() > 20);
  // Used files are found from the path of the model.
  fs::current_path(folder);
  for (const fs::path& path : all) {
    DYNAMIC_SECTION(path.stem().string()) {
      const std::string expected = content(fs::path(path).replace_extension(".expected"));
      CHECK_FALSE(expected.empty());
      CHECK(said_about(path.filename().string(), content(path)) == expected);
    }
  }
}

TEST_CASE("a file that cannot be read is an error of the file as a whole") {
  Diagnostics missing("no/such/model.toml");
  CHECK_FALSE(read_diagram(missing).has_value());
  REQUIRE(missing.sorted().size() == 1);
  CHECK(to_string(missing.sorted()[0]) ==
        "no/such/model.toml: error: cannot be read: No such file or directory");

  Diagnostics directory(folder.string());
  CHECK_FALSE(read_diagram(directory).has_value());
  REQUIRE(directory.sorted().size() == 1);
  CHECK(to_string(directory.sorted()[0]) == folder.string() + ": error: cannot be read: Is a directory");
}

TEST_CASE("no depth of nesting exhausts the stack") {
  const int deep = 100'000;
  const std::string brackets = "flyball = " + std::string(deep, '[');
  CHECK(said_about("m", brackets) == "m:1:75: error: nested more than 64 levels deep\n");
  std::string tables = "a = ";
  for (int k = 0; k < deep; ++k) tables += "{b = ";
  CHECK(said_about("m", tables) == "m:1:325: error: nested more than 64 levels deep\n");
  std::string dotted = "a";
  for (int k = 0; k < deep; ++k) dotted += ".a";
  CHECK(said_about("m", dotted + " = 1") == "m:1:130: error: nested more than 64 levels deep\n");
  CHECK(said_about("m", "[" + dotted + "]") == "m:1:131: error: nested more than 64 levels deep\n");

  const auto value = [](const std::string& text) {
    return said_about("m", "flyball = 1\n[blocks]\nc = { type = \"Constant\", value = \"" + text + "\" }");
  };
  CHECK(value(std::string(deep, '(') + "1") == "m:3:135: error: the expression is nested too deeply\n");
  CHECK(value(std::string(deep, '-') + "1") == "m:3:234: error: the expression is nested too deeply\n");
  CHECK(value("2 m" + std::string(deep, '(')) == "m:3:37: error: unexpected \"m(\"\n");
  std::string sum = "1";
  for (int k = 0; k < deep; ++k) sum += "+1";
  CHECK_THAT(value(sum), Catch::Contains("the expression is nested too deeply"));
  // Each abs uses its argument three times.
  std::string kinks = "x";
  for (int k = 0; k < 40; ++k) kinks = "abs(" + kinks + ")";
  Diagnostics diagnostics("m");
  const std::string model =
      "flyball = 1\n[parameters]\nx = 1.0\n[blocks]\nc = { type = \"Constant\", value = \"" + kinks + "\" }";
  CHECK_FALSE(read_diagram(model, diagnostics).has_value());
  CHECK_THAT(to_string(diagnostics.sorted().at(0)), Catch::Contains("the expression is too long"));
}

TEST_CASE("no line and no wire is longer than what can be told about it") {
  const auto list = [](std::size_t length) {
    const std::string start = "flyball = 1\nx = [";
    return start + std::string(length - std::string("x = [").size() - 1, ' ') + "]\n[blocks]\n";
  };
  CHECK_THAT(said_about("m", list(1'000'000)), Catch::Contains("has no key"));
  CHECK(said_about("m", list(1'000'001)) ==
        "m:2:1000001: error: the line is longer than 1000000 bytes; a list may stand on several lines\n");
  const std::string wide(1'000'000, 'x');
  CHECK(said_about("m", "# \u00E9" + wide) ==
        "m:1:1000000: error: the line is longer than 1000000 bytes; a list may stand on several lines\n");
  std::string wire = "a";
  while (wire.size() <= 100'000) wire += "->b";
  CHECK(said_about("m", "flyball = 1\n[blocks]\n[diagram]\nwires = [\"" + wire + "\"]\n") ==
        "m:4:10: error: the wire is longer than 100000 bytes; write several\n");
}

TEST_CASE("each override is checked as if it stood in the file") {
  const std::string model = R"toml(flyball = 1
[parameters]
gain = { value = 2.0, range = [0.0, 5.0] }
[blocks]
source = { type = "Constant", value = 1.0 }
filter = { type = "TransferFcn", denominator = [1.0, 2.0] }
[diagram]
wires = ["source -> filter"]
)toml";
  const auto said = [&](const std::string& name, const std::string& value) {
    Diagnostics diagnostics("m");
    CHECK_FALSE(read_diagram(model, diagnostics, {{name, value}}).has_value());
    return to_string(diagnostics.sorted().at(0));
  };
  CHECK(said("gian", "1") == "m: error: --set gian: there is no parameter \"gian\"; did you mean \"gain\"?");
  CHECK(said("sorce.value", "1") ==
        "m: error: --set sorce.value: there is no block \"sorce\"; did you mean \"source\"?");
  CHECK(said("source.valeu", "1") ==
        "m: error: --set source.valeu: Constant has no parameter \"valeu\"; did you mean \"value\"?");
  CHECK(said("filter.denominator[2]", "1") ==
        "m: error: --set filter.denominator[2]: block \"filter\" has no entry denominator[2] in the file");
  CHECK(said("gain", "2*") == "m: error: --set gain: the expression ends too early");
  CHECK(said("gain", "7") == "m: error: --set gain: gain is 7, expected from 0 to 5");
}
