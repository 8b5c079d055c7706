#include "studies/metrics/criteria.h"

#include <cmath>

#include "tests/catch.h"

using namespace flyball;

namespace {

std::string model(const std::string& sections) {
  return "flyball = 1\n[blocks]\ncommand = { type = \"Step\", time = \"1 s\", after = \"2 V\" }\n"
         "motor = { type = \"TransferFcn\", numerator = [1], denominator = [0.5, 1] }\n"
         "[diagram]\nwires = [\"command -> motor\"]\nlog = [\"command\", \"motor\"]\n" +
         sections;
}

struct Read {
  std::shared_ptr<const Plan> plan;
  Criteria criteria;
  std::string diagnostics;
};

Read read(const std::string& sections) {
  Diagnostics diagnostics("model.toml");
  Read result;
  if (auto diagram = read_diagram(model(sections), diagnostics)) {
    result.plan = make_plan(std::make_shared<const Diagram>(*std::move(diagram)), diagnostics);
    result.criteria = read_criteria(*result.plan, diagnostics);
  }
  for (const Diagnostic& diagnostic : diagnostics.sorted())
    result.diagnostics += to_string(diagnostic) + '\n';
  return result;
}

}  // namespace

TEST_CASE("Criteria: the sections of a model are read and answered") {
  const Read model = read(
      "[metrics]\nsettling = \"settling(motor, 2 %, from = 1 s)\"\neffort = \"integral(command^2)\"\n"
      "[requirements]\ncalm = \"overshoot(motor) < 5 %\"\nquick = \"settling(motor) < 1 s\"\n");
  REQUIRE(model.diagnostics.empty());
  const RunResult result = run_plan(model.plan, model.plan->diagram->simulation);
  const Assessment assessment = assess(model.criteria, result);
  REQUIRE(assessment.metrics.size() == 2);
  // The way back to rest takes T ln 50, with rows 10 ms apart: (0.01 s)^2/(8 T) = 2.5e-5 s.
  CHECK(assessment.metrics[0].value == Approx(0.5 * std::log(50.0)).margin(3e-5));
  CHECK(assessment.metrics[0].unit == "s");
  CHECK(assessment.metrics[1].value == Approx(36.0).epsilon(1e-12));
  CHECK(assessment.failed() == 1);
  CHECK(assessment.requirements[0].verdict.passed);
  CHECK_FALSE(assessment.requirements[1].verdict.passed);
}

TEST_CASE("Criteria: errors stand where they are in the file, all at once") {
  const Read model = read(
      "[metrics]\nrise = 'rise(moter)'\n  effort =   \"\"\"\n  integral(command) + final(command)\"\"\"\n"
      "[requirements]\n\"calm\" = \"over\\u0073hoot(motor) < 5 s\"\n");
  CHECK(model.diagnostics ==
        "model.toml:9:14: error: unknown name \"moter\"; did you mean \"motor\"?\n"
        "model.toml:11:21: error: kg*m^2/(s^2*A) and V cannot be added or compared\n"
        "model.toml:13:35: error: expected a plain number, found s\n");
}

TEST_CASE("Criteria: a run that was stopped has no metrics and keeps no requirement") {
  const Read model = read("[metrics]\nend = \"final(motor)\"\n[requirements]\nlow = \"max(motor) < 5 V\"\n");
  RunResult result = run_plan(model.plan, model.plan->diagram->simulation);
  result.status = RunStatus::stopped;
  result.end = 0.25;
  const Assessment assessment = assess(model.criteria, result);
  CHECK(std::isnan(assessment.metrics[0].value));
  CHECK(assessment.failed() == 1);
  CHECK(assessment.requirements[0].verdict.message == "the run was stopped at 0.25 s");
}
