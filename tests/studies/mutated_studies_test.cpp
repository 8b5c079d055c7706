// Whatever happens to a study's text, reading it gives a study or errors with positions, and never crashes.
#include "tests/mutator.h"
#include "tests/studies/study_text.h"

using namespace flyball;

namespace {

const std::string valid = R"toml(flyball = 1
[study]
title = "All that a study may say"
models = { servo = "parts/servo.toml", drive = "parts/drive.toml" }
seed = 3
[cases]
hand = { Kp = "3 V", "controller.upper" = "10 V" }
rule = { Kp = "2 V*T/(1 s)" }
fitted = { from = "fit.step", T = "1 s" }
best = { from = "pareto.gains", pick = "knee" }
[scenarios]
nominal = {}
slow = { T = "2 s", simulation = { method = "rk4", step = "1 ms" } }
[sweep]
combine = "zip"
T = ["0.1 s", 0.2, "300 ms"]
K = { from = 1.0, to = 2.0, points = 3, scale = "log" }
[monte_carlo]
runs = 20
sampling = "latin_hypercube"
"wanted.after" = { normal = ["1 rad", "1 deg"], within = ["0.9 rad", "1.1 rad"] }
"controller.N" = { choice = [50.0, 100.0] }
[metrics]
end = "final(y)"
[requirements]
calm = "always abs(y) < 2 rad"
[fit.step]
parameters = { Kp = { range = ["1 V", "9 V"], start = "2 V", scale = 1.0 }, T = ["0.1 s", "5 s"] }
experiments = [{ name = "one", data = "parts/step.csv", match = { y = { column = "y", weight = 2.0 } }, set = { K = 2.0 } }]
requirements = ["calm"]
loss = "huber"
starts = 3
[pareto.gains]
algorithm = "moead"
evaluations = 1000
parameters = { Kp = ["1 V", "9 V"] }
minimise = ["end"]
scenarios = ["slow"]
reference = { end = 3.0 }
pick = "end"
[[plot]]
title = "Steps"
signals = ["y", "controller.u"]
by = "scenario"
[[plot]]
x = "T"
signals = ["end"]
by = "case"
scenario = "slow"
)toml";

}  // namespace

TEST_CASE("the study that is mutated is a valid one") {
  const Study study = test::study_of(valid);
  CHECK(study.fits.size() == 2);
  CHECK(study.plots.size() == 2);
}

TEST_CASE("mutations of a study give a study or positioned errors") {
  int refused = 0;
  constexpr int texts = 600;
  for (unsigned seed = 0; seed < texts; ++seed) {
    test::Mutator mutator(seed);
    std::string text = mutator.mutate(valid);
    // Every other text gets a second mutation, so that mistakes meet.
    if (seed % 2 == 1 && !text.empty()) text = mutator.mutate(text);
    Diagnostics diagnostics((test::study_folder() / "study.toml").string());
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
