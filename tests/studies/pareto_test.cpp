#include "studies/pareto/pareto.h"

#include <cmath>

#include "studies/pareto/front.h"
#include "tests/catch.h"

using namespace flyball;

namespace {

// Schaffer's problem: f = x^2 and g = (x - 2)^2, whose front is x from 0 to 2. Runs with x > 3 break off.
constexpr const char* schaffer = R"(flyball = 1
[parameters]
x = 1.0
[blocks]
x     = { type = "Constant", value = "x" }
f     = { type = "Expression", formula = "u^2", inputs = ["u"] }
g     = { type = "Expression", formula = "(u - 2)^2", inputs = ["u"] }
small = { type = "Expression", formula = "3 - u", inputs = ["u"] }
guard = { type = "Assertion" }
[diagram]
wires = ["x -> f.u, g.u, small.u", "small -> guard"]
log = ["f", "g"]
[simulation]
stop = "1 s"
log_interval = "1 s"
)";

Study study_of(const std::string& algorithm, const std::vector<std::string>& requirements = {}) {
  Diagnostics diagnostics("schaffer.toml");
  auto diagram = read_diagram(schaffer, diagnostics);
  REQUIRE(diagram);
  auto plan = make_plan(std::make_shared<const Diagram>(*std::move(diagram)), diagnostics);
  REQUIRE(plan);
  Study study;
  study.scenarios.emplace_back().name = "nominal";
  study.metrics = {{"f", "final(f)"}, {"g", "final(g)"}, {"near", "-final(g)"}};
  StudyModel model;
  model.name = "schaffer";
  model.plan = plan;
  for (const auto& [name, text] : study.metrics) model.metrics.emplace_back(text, plan->columns);
  for (const std::string& text : requirements) {
    study.requirements.emplace_back("wanted", text);
    model.requirements.emplace_back(text, plan->columns, ".");
  }
  study.models.push_back(std::move(model));
  ParetoDefinition front;
  front.name = "front";
  front.algorithm = algorithm;
  front.evaluations = 2000;
  front.population = 40;
  Sought& x = front.parameters.emplace_back();
  x.name = "x";
  x.lower = -10.0;
  x.upper = 10.0;
  front.minimise = {0, 1};
  front.reference = {4.0, 4.0};
  study.fronts.push_back(std::move(front));
  return study;
}

ParetoResult front_of(const Study& study, int threads = 1, const std::function<bool(double)>& progress = {}) {
  Evaluator evaluator(study.models);
  return run_pareto(study, study.fronts[0], evaluator, threads, progress);
}

bool same_points(const ParetoResult& a, const ParetoResult& b) {
  return std::ranges::equal(a.front, b.front, [](const ParetoPoint& p, const ParetoPoint& q) {
    return p.parameters == q.parameters && p.objectives == q.objectives;
  });
}

}  // namespace

TEST_CASE("Each algorithm finds the front of Schaffer's problem") {
  for (const std::string algorithm : {"nsga2", "nspso", "moead", "mopso"}) {
    INFO(algorithm);
    const Study study = study_of(algorithm);
    const ParetoResult result = front_of(study);
    CHECK(result.front.size() >= 30);
    CHECK(result.front.size() <= 40);
    for (const ParetoPoint& point : result.front) {
      const double x = point.parameters[0];
      // A point off the front by d costs at most 4 d in an objective: within 0.5 % of the ranges.
      CHECK(x > -0.005);
      CHECK(x < 2.005);
      CHECK(point.objectives[0] == x * x);
    }
    // Below (4, 4) lies 16 - integral of (sqrt f - 2)^2 = 40/3; 40 even points leave steps of about 0.15 in
    // all.
    CHECK(result.hypervolume == Approx(40.0 / 3.0).epsilon(0.02));
    CHECK(result.hypervolume < 40.0 / 3.0);
    CHECK(result.evaluations == 2000);
    CHECK(result.failed > 0);
    // At the knee f + g is least.
    CHECK(result.front[static_cast<std::size_t>(result.picked)].parameters[0] == Approx(1.0).margin(0.1));
    REQUIRE(result.settings().size() == 1);
    CHECK(result.settings()[0].name == "x");
  }
}

TEST_CASE("A front is the same with any number of threads, and another with another seed") {
  Study study = study_of("nsga2");
  study.fronts[0].evaluations = 400;
  const ParetoResult one = front_of(study, 1);
  CHECK(same_points(one, front_of(study, 1)));
  CHECK(same_points(one, front_of(study, 2)));
  CHECK(same_points(one, front_of(study, 8)));
  study.seed = 2;
  CHECK_FALSE(same_points(one, front_of(study)));
}

TEST_CASE("All points of a front hold its requirements") {
  Study study = study_of("nsga2", {"final(f) >= 1"});
  study.fronts[0].requirements = {0};
  const ParetoResult result = front_of(study);
  REQUIRE(result.front.size() > 10);
  for (const ParetoPoint& point : result.front) CHECK(point.objectives[0] >= 1.0);
  // x from 1 to 2 is left.
  CHECK(result.front.front().parameters[0] == Approx(1.0).margin(0.02));
}

TEST_CASE("What is maximised keeps its sign") {
  Study study = study_of("nsga2");
  study.fronts[0].minimise = {0};
  study.fronts[0].maximise = {2};
  study.fronts[0].reference = {4.0, -4.0};
  const ParetoResult result = front_of(study);
  CHECK(result.objectives == std::vector<std::string>{"f", "near"});
  for (const ParetoPoint& point : result.front) CHECK(point.objectives[1] <= 0.0);
  CHECK(result.reference == std::vector{4.0, -4.0});
  CHECK(result.hypervolume == Approx(40.0 / 3.0).epsilon(0.02));
}

TEST_CASE("A front without a point that counts is empty") {
  Study study = study_of("nsga2", {"final(f) < 0"});
  study.fronts[0].requirements = {0};
  study.fronts[0].evaluations = 80;
  const ParetoResult result = front_of(study);
  CHECK(result.front.empty());
  CHECK(result.picked == -1);
  CHECK(result.settings().empty());
}

TEST_CASE("A search that is told to end gives what it has") {
  const ParetoResult result = front_of(study_of("nsga2"), 1, [](double part) { return part < 0.5; });
  CHECK_FALSE(result.front.empty());
  CHECK(result.evaluations >= 1000);
  CHECK(result.evaluations < 1100);
}

TEST_CASE("A population that an algorithm cannot use is refused") {
  Study study = study_of("nsga2");
  study.fronts[0].population = 42;
  CHECK_THROWS_WITH(front_of(study),
                    "nsga2 pairs its population in fours: expected a multiple of 4 from 8 on, found 42");
  study.fronts[0].algorithm = "moead";
  study.fronts[0].population = 3;
  CHECK_THROWS_WITH(front_of(study), "a population of 3 is too small: expected at least 4");
  study.fronts[0].algorithm = "nsga3";
  study.fronts[0].population = 40;
  CHECK_THROWS_WITH(front_of(study), "there is no algorithm \"nsga3\"");
}
