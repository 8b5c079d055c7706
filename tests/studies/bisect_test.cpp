#include "studies/engine/bisect.h"

#include "tests/studies/study_text.h"

using namespace flyball;

namespace {

// The signal x is p1 of the model, or what a case makes of it.
const std::string limits = R"toml(flyball = 1
[study]
model = "parts/many.toml"
[cases]
plain = {}
doubled = { "x.value" = "2*p1" }
constant = { "x.value" = "p2" }
beyond = { "x.value" = "p1 + 1" }
[requirements]
low = "final(x) < 1.3"
[bisect.up]
parameter = "p1"
between = [0.0, 2.0]
tolerance = 1e-6
requirement = "low"
)toml";

BisectResult run(const Study& study) {
  Evaluator evaluator(study.models);
  return run_bisect(study, study.bisections.at(0), study.cases, evaluator);
}

}  // namespace

TEST_CASE("bisection finds the value at which a requirement begins to be broken") {
  const BisectResult result = run(test::study_of(limits));
  CHECK(result.name == "up");
  CHECK(result.parameter == "p1");
  REQUIRE(result.limits.size() == 4);
  // Half of the last interval, which is not longer than the tolerance.
  CHECK(result.limits[0].value == Approx(1.3).margin(0.5e-6));
  CHECK(result.limits[0].holds < 1.3);
  CHECK(result.limits[0].broken >= 1.3);
  CHECK(result.limits[0].broken - result.limits[0].holds <= 1e-6);
  // Both ends, and ceil(log2(2/1e-6)) halvings.
  CHECK(result.limits[0].runs == 2 + 21);
  CHECK(result.limits[1].value == Approx(0.65).margin(0.5e-6));
  CHECK(result.limits[3].value == Approx(0.3).margin(0.5e-6));
  CHECK(result.limits[3].choice == 3);
}

TEST_CASE("a bisection whose ends say the same has no value, and says so") {
  const BisectResult result = run(test::study_of(limits));
  CHECK(std::isnan(result.limits[2].value));
  CHECK(result.limits[2].reason == "the requirement holds at both ends of the range");
  CHECK(result.limits[2].runs == 2);
}

TEST_CASE("bisection goes the other way where the requirement is broken at the lower end") {
  std::string text = limits;
  text.replace(text.find("final(x) < 1.3"), 14, "final(x) > 1.3");
  const BisectResult result = run(test::study_of(text));
  CHECK(result.limits[0].value == Approx(1.3).margin(0.5e-6));
  CHECK(result.limits[0].holds > result.limits[0].broken);
  CHECK(result.limits[2].reason == "the requirement is broken at both ends of the range");
}
