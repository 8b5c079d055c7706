#include "studies/engine/evaluator.h"

#include <cmath>
#include <set>

#include "tests/catch.h"
#include "tests/studies/engine/small_studies.h"

using namespace flyball;
using namespace flyball::test;

namespace {

EvaluatorOptions with_logs(int threads = 1) {
  EvaluatorOptions options;
  options.threads = threads;
  options.keep_logs = true;
  return options;
}

/// Times, then columns.
std::vector<double> numbers(const RunRecord& record) { return record.log->data(); }

double last(const RunRecord& record, int column) { return record.log->value(record.log->rows() - 1, column); }

/// Runs of several forms, in an order in which groups are mixed.
std::vector<RunRequest> mixed_requests() {
  std::vector<RunRequest> requests;
  for (int k = 0; k < 30; ++k) {
    RunRequest request{0, {{"T", 0.2 + 0.1 * k}, {"deviation", 0.1}}, static_cast<std::uint64_t>(k % 7)};
    if (k % 5 == 1) request.settings.push_back({"period", std::string("0.2 s")});
    if (k % 5 == 3) request.settings.push_back({"simulation.method", std::string("bdf")});
    if (k % 11 == 10) request.settings.push_back({"T", -1.0});
    requests.push_back(request);
  }
  return requests;
}

}  // namespace

TEST_CASE("Settings reach their runs by name, later ones win") {
  const std::vector<StudyModel> models{study_model(lag_model)};
  Evaluator evaluator(models);
  const std::vector<RunRequest> requests{{0, {{"x0", 2.0}}}, {0, {{"T", 9.0}, {"x0", 3.0}, {"T", 0.25}}}};
  const auto records = evaluator.run(requests, with_logs());
  // x = x0 exp(-t/T); a step's error is at most 1e-6 of x, and there are fifty.
  CHECK(last(records[0], 0) == Approx(2.0 * std::exp(-2.0)).epsilon(5e-5));
  CHECK(last(records[1], 0) == Approx(3.0 * std::exp(-4.0)).epsilon(5e-5));
  CHECK(records[0].status == RunStatus::finished);
  CHECK(records[0].end == 1.0);
}

TEST_CASE("A text, and a number that fixes structure, take a plan of their own") {
  const std::vector<StudyModel> models{study_model(lag_model)};
  Evaluator evaluator(models);
  const std::vector<Setting> number{{"period", 0.25}}, text{{"period", std::string("250 ms")}};
  for (const auto& settings : {number, text}) {
    const auto plan = evaluator.plan(0, settings);
    CHECK(plan != models[0].plan);
    CHECK(plan->hit_rates.at(0).period == *Rational::fraction(1, 4));
  }
  const std::vector<Setting> formula{{"x0", std::string("2*T/(1 s)")}};
  const auto records = evaluator.run(std::vector<RunRequest>{{0, formula}}, with_logs());
  CHECK(last(records[0], 0) == Approx(std::exp(-2.0)).epsilon(5e-5));
  CHECK(evaluator.plan(0, {}) == models[0].plan);
}

TEST_CASE("Settings of the simulation belong to their run") {
  const std::vector<StudyModel> models{study_model(lag_model)};
  Evaluator evaluator(models);
  const std::vector<RunRequest> requests{
      {0, {{"simulation.stop", 0.5}}},
      {0, {{"simulation.log_interval", 0.25}}},
      {0, {{"simulation.method", std::string("euler")}, {"simulation.step", 0.1}}}};
  const auto records = evaluator.run(requests, with_logs());
  CHECK(records[0].end == 0.5);
  CHECK(records[1].log->time(1) == 0.25);
  CHECK(last(records[2], 0) == Approx(std::pow(1.0 - 0.1 / 0.5, 10)));
}

TEST_CASE("A run that cannot be is a record with its reason") {
  const std::vector<StudyModel> models{study_model(lag_model)};
  Evaluator evaluator(models);
  const auto reason = [&](const std::vector<Setting>& settings) {
    const auto records = evaluator.run(std::vector<RunRequest>{{0, settings}, {0, {}}}, with_logs());
    CHECK(records[0].status == RunStatus::stopped);
    CHECK(records[1].status == RunStatus::finished);
    return records[0].reason;
  };
  CHECK(reason({{"T", -1.0}}) == "T is -1, outside its range [0.01, 100]");
  CHECK(reason({{"TT", 1.0}}) ==
        "lag.toml: error: --set TT: there is no parameter \"TT\"; known: T, x0, deviation, period");
  CHECK(reason({{"simulation.method", std::string("dp6")}}).find("did you mean \"dp5\"?") !=
        std::string::npos);
  CHECK(reason({{"simulation.method", std::string("discrete")}}).find("there are continuous states") !=
        std::string::npos);
  CHECK(reason({{"simulation.rtol", 0.0}}) == "simulation.rtol: \"0\": expected a value above 0 1, found 0");
  CHECK(reason({{"simulation.rtol", std::string("tight")}}) ==
        "simulation.rtol: \"tight\": unknown name \"tight\" (at character 1)");
  CHECK(reason({{"simulation.tol", 1.0}}) == "there is no setting simulation.tol of a simulation");
}

TEST_CASE("The same requests give the same numbers with any number of threads") {
  const std::vector<StudyModel> models{study_model(lag_model)};
  const auto requests = mixed_requests();
  Evaluator first(models);
  const auto expected = first.run(requests, with_logs());
  for (const int threads : {2, 8}) {
    Evaluator evaluator(models);
    const auto records = evaluator.run(requests, with_logs(threads));
    for (std::size_t k = 0; k < requests.size(); ++k) {
      CHECK(records[k].reason == expected[k].reason);
      CHECK(numbers(records[k]) == numbers(expected[k]));
    }
  }
}

TEST_CASE("A group of runs gives the same numbers whichever groups were run before") {
  const std::vector<StudyModel> models{study_model(lag_model)};
  const auto requests = mixed_requests();
  Evaluator whole(models), part(models);
  const auto expected = whole.run(requests, with_logs());
  const auto group = std::span(requests).subspan(2 * group_size, group_size);
  const auto records = part.run(group, with_logs());
  for (std::size_t k = 0; k < group.size(); ++k)
    CHECK(numbers(records[k]) == numbers(expected[2 * group_size + k]));
}

TEST_CASE("Runs are told one at a time, and each once") {
  const std::vector<StudyModel> models{study_model(lag_model)};
  Evaluator evaluator(models);
  std::set<std::size_t> told;
  int inside = 0;
  EvaluatorOptions options;
  options.threads = 4;
  options.done = [&](std::size_t run, const RunRecord&) {
    REQUIRE(++inside == 1);
    told.insert(run);
    --inside;
  };
  evaluator.run(mixed_requests(), options);
  CHECK(told.size() == 30);
}

TEST_CASE("Work that is cancelled leaves its runs as interrupted") {
  const std::vector<StudyModel> models{study_model(lag_model)};
  Evaluator evaluator(models);
  EvaluatorOptions options;
  int told = 0;
  options.done = [&](std::size_t, const RunRecord&) { ++told; };
  options.cancelled = [&] { return told >= group_size; };
  const auto records = evaluator.run(mixed_requests(), options);
  CHECK(told == group_size);
  CHECK(records[group_size - 1].status == RunStatus::finished);
  CHECK(records[group_size].status == RunStatus::interrupted);
}

TEST_CASE("What takes the results may fail: its error comes out, on any number of threads") {
  const std::vector<StudyModel> models{study_model(lag_model)};
  Evaluator evaluator(models);
  for (const int threads : {1, 4}) {
    EvaluatorOptions options;
    options.threads = threads;
    options.done = [](std::size_t, const RunRecord&) { throw std::runtime_error("the disk is full"); };
    CHECK_THROWS_WITH(evaluator.run(mixed_requests(), options), "the disk is full");
  }
}
