// Each broken study broken/NAME.toml with what is said about it, line by line, in NAME.expected.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/studies/study_text.h"

using namespace flyball;
namespace fs = std::filesystem;

namespace {

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string said_about(const std::string& name, std::string_view text) {
  Diagnostics diagnostics(name);
  const auto study = read_study(text, diagnostics);
  CHECK(study.has_value() == !diagnostics.failed());
  std::string lines;
  for (const Diagnostic& diagnostic : diagnostics.sorted()) lines += to_string(diagnostic) + "\n";
  return lines;
}

}  // namespace

TEST_CASE("broken studies are told what is wrong, line by line") {
  std::vector<fs::path> all;
  for (const auto& entry : fs::directory_iterator(test::study_folder())) {
    if (entry.path().extension() == ".toml") all.push_back(entry.path());
  }
  std::ranges::sort(all);
  REQUIRE(all.size() > 10);
  // Models are found from the path of the study.
  fs::current_path(test::study_folder());
  for (const fs::path& path : all) {
    DYNAMIC_SECTION(path.stem().string()) {
      const std::string expected = content(fs::path(path).replace_extension(".expected"));
      CHECK_FALSE(expected.empty());
      CHECK(said_about(path.filename().string(), content(path)) == expected);
    }
  }
}
