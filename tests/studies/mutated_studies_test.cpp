// Whatever happens to a study's text, reading it gives a study or errors with positions, and never crashes.
#include "studies/file.h"
#include "tests/mutator.h"
#include "tests/studies/study_text.h"

using namespace flyball;

namespace {

const std::filesystem::path file =
    std::filesystem::path(source_dir()) / "tests" / "studies" / "everything.toml";

}  // namespace

TEST_CASE("the study that is mutated is a valid one") {
  Diagnostics diagnostics(file.string());
  const auto study = read_study(read_file(file), diagnostics);
  for (const Diagnostic& diagnostic : diagnostics.sorted()) UNSCOPED_INFO(to_string(diagnostic));
  REQUIRE(study.has_value());
  CHECK(study->fits.size() == 2);
  CHECK(study->plots.size() == 2);
}

TEST_CASE("mutations of a study give a study or positioned errors") {
  const std::string valid = read_file(file);
  int refused = 0;
  constexpr int texts = 600;
  for (unsigned seed = 0; seed < texts; ++seed) {
    test::Mutator mutator(seed);
    std::string text = mutator.mutate(valid);
    // Every other text gets a second mutation, so that mistakes meet.
    if (seed % 2 == 1 && !text.empty()) text = mutator.mutate(text);
    Diagnostics diagnostics(file.string());
    const auto study = read_study(text, diagnostics);
    CAPTURE(seed, text);
    REQUIRE(study.has_value() == !diagnostics.failed());
    for (const Diagnostic& diagnostic : diagnostics.sorted()) {
      REQUIRE(diagnostic.at.line >= 1);
      REQUIRE(diagnostic.at.column >= 1);
      REQUIRE_FALSE(diagnostic.message.empty());
    }
    if (!study) ++refused;
  }
  // Most mutations break something; else the mutator or the reader does not do its work.
  CHECK(refused > texts / 2);
}
