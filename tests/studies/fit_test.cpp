#include "studies/fit/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/catch.h"
#include "tests/studies/fit_case.h"

using namespace flyball;
using namespace flyball::test;

namespace {

/// y = K (1 - exp(-t/T)) from y = 0.
const std::string lag = R"toml(
flyball = 1
[parameters]
K = { value = "2 m" }
T = { value = "500 ms" }
u = 1.0
[blocks]
step = { type = "Constant", value = "u" }
wanted = { type = "Gain", gain = "K" }
error = { type = "Sum", signs = "+-" }
rate = { type = "Gain", gain = "1/T" }
y = { type = "Integrator", initial = "0 m" }
[diagram]
wires = ["step -> wanted -> error.u1", "y -> error.u2", "error -> rate -> y"]
log = ["y"]
[simulation]
stop = 3
)toml";

double lagged(double t, double K, double T) { return K * (1.0 - std::exp(-t / T)); }

/// Rows of time and y(t), 31 from 0 s to 3 s.
std::string lag_data(const std::string& header, double K, double T, double y0 = 0.0) {
  std::string csv = header + '\n';
  for (const double t : time_grid(0.0, 3.0, 30))
    csv += fmt::format("{},{}\n", t, lagged(t, K, T) + y0 * std::exp(-t / T));
  return csv;
}

FitExperiment experiment(const TemporaryFolder& folder, const std::string& name, const std::string& csv,
                         std::vector<Setting> settings = {}) {
  write_file(folder / (name + ".csv"), csv);
  return {name, folder / (name + ".csv"), {{"y", "y", 1.0}}, std::move(settings)};
}

FitCase lag_case(const TemporaryFolder& folder) {
  FitCase c = fit_case(lag);
  c.fit.parameters = {from("K", 1.0), from("T", 1.0)};
  c.fit.experiments = {experiment(folder, "step", lag_data("time,y", 2.5, 0.4))};
  return c;
}

/// y = a + b t.
const std::string line = R"toml(
flyball = 1
[parameters]
a = 0.0
b = 1.0
idle = 3.0
[blocks]
t = { type = "Clock" }
y = { type = "Expression", inputs = ["t"], formula = "a + b*t" }
z = { type = "Gain", gain = "idle" }
[diagram]
wires = ["t -> y, z"]
log = ["y", "z"]
[simulation]
stop = 4
)toml";

/// 1 + 2 t with a little of something else.
const std::string line_data = "time,y\n0,1.1\n1,2.9\n2,5.0\n3,7.2\n4,8.8\n";

FitCase line_case(const TemporaryFolder& folder, const std::string& csv = line_data) {
  FitCase c = fit_case(line);
  c.fit.parameters = {from("a", 0.5), from("b", 0.5)};
  c.fit.experiments = {experiment(folder, "line", csv)};
  return c;
}

/// What a fit says that cannot begin.
std::string refusal(const FitCase& c) {
  try {
    c.run();
  } catch (const FitError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("Fit: a straight line has the errors and the correlation of the closed form") {
  const TemporaryFolder folder;
  const FitResult result = line_case(folder).run();
  // Normal equations by hand: n = 5, sum t = 10, sum t^2 = 30, sum y = 25, sum t y = 69.7.
  const double b = (5.0 * 69.7 - 10.0 * 25.0) / (5.0 * 30.0 - 100.0), a = (25.0 - b * 10.0) / 5.0;
  double squares = 0.0;
  const double data[] = {1.1, 2.9, 5.0, 7.2, 8.8};
  for (int t = 0; t < 5; ++t) squares += std::pow(data[t] - a - b * t, 2);
  const double variance = squares / 3.0;
  CHECK(result.converged);
  // A linear problem: what is left is rounding, and the solver's tolerance of 1e-10.
  CHECK(found(result, "a").value == Approx(a).epsilon(1e-9));
  CHECK(found(result, "b").value == Approx(b).epsilon(1e-9));
  CHECK(found(result, "a").standard_error == Approx(std::sqrt(variance * 30.0 / 50.0)).epsilon(1e-8));
  CHECK(found(result, "b").standard_error == Approx(std::sqrt(variance * 5.0 / 50.0)).epsilon(1e-8));
  CHECK(result.correlation[1] == Approx(-10.0 / std::sqrt(5.0 * 30.0)).epsilon(1e-8));
  // Columns of length 1 whose angle has the cosine c: (1 + c)/(1 - c) under a root.
  const double cosine = 10.0 / std::sqrt(150.0);
  CHECK(result.condition == Approx(std::sqrt((1.0 + cosine) / (1.0 - cosine))).epsilon(1e-8));
  CHECK(result.cost == Approx(0.5 * squares).epsilon(1e-9));
  CHECK(result.residuals == 5);
  CHECK(result.remarks.empty());
  REQUIRE(result.experiments.size() == 1);
  CHECK(result.experiments[0].signals[0].data == std::vector<double>{1.1, 2.9, 5.0, 7.2, 8.8});
  CHECK(result.experiments[0].signals[0].before[4] == Approx(2.5));
  CHECK(result.experiments[0].signals[0].after[4] == Approx(a + 4.0 * b));
}

TEST_CASE("Fit: units of the data's header count, and so do those of parameters") {
  const TemporaryFolder folder;
  FitCase c = lag_case(folder);
  std::string csv = "t [ms],pos,y [mm]\n";
  for (const double t : time_grid(0.0, 3.0, 30))
    csv += fmt::format("{},7,{}\n", 1e3 * t, 1e3 * lagged(t, 2.5, 0.4));
  c.fit.experiments = {experiment(folder, "step", csv)};
  const FitResult result = c.run();
  CHECK(found(result, "K").value == Approx(2.5).epsilon(1e-7));
  CHECK(found(result, "T").value == Approx(0.4).epsilon(1e-7));
  CHECK(found(result, "K").unit == "m");
  CHECK(found(result, "T").unit == "s");
}

TEST_CASE("Fit: several experiments, each with its own settings, and a start that is looked for") {
  const TemporaryFolder folder;
  FitCase c = fit_case(lag);
  c.fit.parameters = {from("K", 1.0), from("T", 1.0), from("y.initial", 0.0)};
  c.fit.experiments = {experiment(folder, "once", lag_data("time,y", 2.5, 0.4, 0.3)),
                       experiment(folder, "twice", lag_data("time,y", 5.0, 0.4, 0.3), {{"u", 2.0}})};
  const FitResult result = c.run();
  CHECK(result.gradient == "exact");
  CHECK(found(result, "K").value == Approx(2.5).epsilon(1e-7));
  CHECK(found(result, "T").value == Approx(0.4).epsilon(1e-7));
  CHECK(found(result, "y.initial").value == Approx(0.3).epsilon(1e-7));
  // Threads do not count.
  const FitResult again = c.run(2);
  CHECK(again.cost == result.cost);
  CHECK(found(again, "T").value == found(result, "T").value);
  c.fit.experiments[1].settings = {{"T", 1.0}};
  CHECK(refusal(c) == "error: T is sought, and set by the experiment twice");
  // Another method takes no other plan; its name is a text.
  c.fit.experiments[1].settings = {{"u", 2.0}, {"simulation.method", std::string("bdf")}};
  CHECK(found(c.run(), "K").value == Approx(2.5).epsilon(1e-6));
}

TEST_CASE("Fit: numeric gradients lead to the same place") {
  const TemporaryFolder folder;
  FitCase c = lag_case(folder);
  c.fit.gradient = "numeric";
  const FitResult result = c.run();
  CHECK(result.converged);
  CHECK(result.gradient == "numeric");
  CHECK(found(result, "K").value == Approx(2.5).epsilon(1e-7));
  CHECK(found(result, "T").value == Approx(0.4).epsilon(1e-7));
}

TEST_CASE("Fit: bounds hold, and an answer at one is told") {
  const TemporaryFolder folder;
  FitCase c = lag_case(folder);
  c.fit.parameters[0].upper = 2.0;
  const FitResult result = c.run();
  CHECK(result.converged);
  CHECK(found(result, "K").value == Approx(2.0).epsilon(1e-12));
  CHECK(found(result, "K").at_bound);
  CHECK(std::isnan(found(result, "K").standard_error));
  CHECK_FALSE(found(result, "T").at_bound);
  CHECK(remarks_contain(result, "K is at its bound 2"));
}

TEST_CASE("Fit: what the data cannot tell is said in words") {
  const TemporaryFolder folder;
  FitCase c = lag_case(folder);
  // K and u only count as their product.
  c.fit.parameters = {from("K", 1.5), from("u", 1.2), from("T", 1.0)};
  const FitResult product = c.run();
  CHECK(found(product, "K").value * found(product, "u").value == Approx(2.5).epsilon(1e-6));
  CHECK(
      remarks_contain(product, "K and u: the data tell only a combination of them; fix one or excite more"));
  CHECK(std::isnan(found(product, "K").standard_error));
  CHECK(std::isfinite(found(product, "T").standard_error));
  CHECK(product.correlation[1] == Approx(-1.0).epsilon(1e-6));

  FitCase idle = line_case(folder);
  idle.fit.parameters.push_back(from("idle", 1.0));
  const FitResult without = idle.run();
  CHECK(without.converged);
  CHECK(
      remarks_contain(without, "idle has no influence on the data; fix it, or match a signal that it moves"));
  CHECK(std::isfinite(found(without, "b").standard_error));

  // Far from t = 0, offset and slope of a line go together.
  FitCase far = line_case(folder, "time,y\n100,201.1\n101,202.9\n102,205\n103,207.1\n");
  CHECK(remarks_contain(far.run(), "a and b: correlation -1.000; fix one or excite more"));

  FitCase few = line_case(folder, "time,y\n1,3\n2,5\n");
  const FitResult exact = few.run();
  CHECK(found(exact, "b").value == Approx(2.0));
  CHECK(remarks_contain(exact, "2 residuals cannot tell 2 parameters with their errors"));
}

TEST_CASE("Fit: robust losses do not follow a wild row") {
  const TemporaryFolder folder;
  const std::string wild = "time,y\n0,1\n0.5,2\n1,3\n1.5,4\n2,55\n2.5,6\n3,7\n3.5,8\n4,9\n";
  FitCase c = line_case(folder, wild);
  CHECK(std::fabs(found(c.run(), "a").value - 1.0) > 1.0);
  for (const std::string loss : {"huber", "soft_l1", "cauchy"}) {
    c.fit.loss = loss;
    c.fit.loss_scale = 0.01;
    const FitResult result = c.run();
    INFO(loss << ": " << result.reason << " after " << result.iterations);
    CHECK(result.converged);
    // One row pulls with the scale at most (Huber), on nine.
    CHECK(std::fabs(found(result, "a").value - 1.0) < 0.02);
    CHECK(std::fabs(found(result, "b").value - 2.0) < 0.02);
  }
  c.fit.loss = "hubert";
  CHECK(refusal(c) == "error: there is no loss \"hubert\"; known: squared, huber, soft_l1, cauchy");
}

TEST_CASE("Fit: models that pass no derivatives on are fitted by differences, and say so") {
  const TemporaryFolder folder;
  FitCase c = shipped_fit_case("classic/smith_predictor.toml");
  write_file(folder / "record.csv", to_csv(reference_run(c.plan(), time_grid(0.0, 5.0, 97))));
  c.fit.experiments = {{"record", folder / "record.csv", {{"process", "process", 1.0}}, {}}};
  c.fit.parameters = {from("K", 2.2), from("L", 1.05)};
  const FitResult result = c.run();
  INFO(result.reason << ", cost " << result.cost);
  CHECK(result.converged);
  CHECK(result.gradient == "numeric");
  CHECK(remarks_contain(result, "so the gradient is by central differences"));
  CHECK(found(result, "K").value == Approx(2.0).epsilon(1e-6));
  CHECK(found(result, "L").value == Approx(1.0).epsilon(1e-6));
  // The controller cancels the lag: only gain over time constant is left.
  c.fit.parameters = {from("K", 2.2), from("T", 0.45)};
  CHECK(remarks_contain(c.run(), "K and T: the data tell only a combination of them"));
}

TEST_CASE("Fit: a simulation that fails is a step that is not taken") {
  const TemporaryFolder folder;
  // The root ends the run where a t > 1.
  FitCase c = fit_case(R"toml(
flyball = 1
[parameters]
a = 0.1
[blocks]
t = { type = "Clock" }
y = { type = "Expression", inputs = ["t"], formula = "sqrt(1 - a*t)" }
[diagram]
wires = ["t -> y"]
log = ["y"]
[simulation]
stop = 1
)toml");
  std::string csv = "time,y\n";
  for (const double t : time_grid(0.0, 1.0, 20)) csv += fmt::format("{},{}\n", t, std::sqrt(1.0 - 0.99 * t));
  c.fit.experiments = {experiment(folder, "root", csv)};
  c.fit.parameters = {from("a", -3.0)};
  const FitResult result = c.run();
  CHECK(result.converged);
  CHECK(found(result, "a").value == Approx(0.99).epsilon(1e-7));

  c.fit.parameters = {from("a", 2.0)};
  const FitResult failed = c.run();
  CHECK_FALSE(failed.converged);
  CHECK_THAT(failed.reason, Catch::StartsWith("the start cannot be simulated: "));
  CHECK(std::isnan(failed.cost));
  CHECK(failed.parameters[0].value == 2.0);
  // Other starts may do.
  c.fit.starts = 6;
  CHECK(found(c.run(), "a").value == Approx(0.99).epsilon(1e-7));
}

TEST_CASE("Fit: of many starts, the best answer counts") {
  const TemporaryFolder folder;
  FitCase c = fit_case(R"toml(
flyball = 1
[parameters]
w = 1.0
[blocks]
t = { type = "Clock" }
y = { type = "Expression", inputs = ["t"], formula = "sin(w*t)" }
[diagram]
wires = ["t -> y"]
log = ["y"]
[simulation]
stop = 10
)toml");
  std::string csv = "time,y\n";
  for (const double t : time_grid(0.0, 10.0, 100)) csv += fmt::format("{},{}\n", t, std::sin(3.0 * t));
  c.fit.experiments = {experiment(folder, "wave", csv)};
  c.fit.parameters = {from("w", 1.0)};
  c.fit.parameters[0].lower = 0.1;
  c.fit.parameters[0].upper = 6.0;
  CHECK(c.run().cost > 1.0);
  c.fit.starts = 12;
  const FitResult result = c.run();
  CHECK(found(result, "w").value == Approx(3.0).epsilon(1e-8));
  CHECK(remarks_contain(result, "of 12 starts ended at the least cost"));
  CHECK(c.run(2).remarks == result.remarks);
}

TEST_CASE("Fit: what progress says ends the search, and what was found by then is kept") {
  const TemporaryFolder folder;
  const FitCase c = lag_case(folder);
  Evaluator evaluator(c.study.models);
  std::vector<double> costs;
  const FitResult result = run_fit(c.study, c.fit, evaluator, 1, [&](int iteration, double cost) {
    costs.push_back(cost);
    return iteration == 0 || cost == costs.front();  // until a step is taken
  });
  CHECK_FALSE(result.converged);
  CHECK(result.reason == "interrupted");
  CHECK(std::ranges::is_sorted(costs, std::greater<>()));
  CHECK(result.cost == costs.back());
  CHECK(result.cost < result.cost_before);
  CHECK(found(result, "K").value != 1.0);

  FitCase few = lag_case(folder);
  few.fit.max_iterations = 1;
  CHECK(few.run().reason == "stopped after 1 iterations, as max_iterations says");
}

TEST_CASE("Fit: what cannot be fitted is refused with the reason, all at once") {
  const TemporaryFolder folder;
  FitCase c = fit_case(R"toml(
flyball = 1
[parameters]
gain = 2.0
twice = "2*gain"
h = 0.1
[blocks]
t = { type = "Clock" }
y = { type = "Gain", gain = "gain" }
z = { type = "ZeroOrderHold", sample_time = "h" }
[diagram]
wires = ["t -> y -> z"]
log = ["y"]
[simulation]
stop = 1
)toml");
  c.fit.experiments = {experiment(folder, "line", "time,y\n0,0\n1,3\n")};
  c.fit.parameters = {from("gian", 1.0), from("twice", 1.0), from("h", 1.0), from("gain", 1.0),
                      from("gain", 1.0)};
  CHECK(refusal(c) ==
        "error: there is no parameter \"gian\"; did you mean \"gain\"?\n"
        "error: twice is computed from other parameters\n"
        "error: h fixes the structure of a block: it takes a new plan\n"
        "error: gain is sought twice");
  c.fit.at = {12, 3};
  c.study.file = "study.toml";
  c.fit.parameters = {from("h", 1.0)};
  CHECK(refusal(c) ==
        "study.toml:12:3: error: fit.test: h fixes the structure of a block: it takes a new plan");
  c.fit.at = {};
  c.fit.parameters = {from("gain", 7.0)};
  c.fit.parameters[0].upper = 5.0;
  CHECK_THAT(refusal(c), Catch::StartsWith("error: gain: ") && Catch::Contains("7"));
  c.fit.parameters = {from("gain", 1.0)};
  c.fit.experiments[0].matches[0].signal = "Y";
  CHECK_THAT(refusal(c), Catch::Contains("there is no logged signal \"Y\"; known: y"));
  c.fit.experiments.clear();
  CHECK(refusal(c) == "error: there is nothing to compare the model with");
  c.fit.parameters.clear();
  CHECK(refusal(c) == "error: there is no parameter to fit");
}

TEST_CASE("Fit: data that do not fit the model are refused with their place") {
  const TemporaryFolder folder;
  const auto complaint = [&](const std::string& csv, const std::string& column = "y") {
    FitCase c = fit_case(lag);
    c.fit.parameters = {from("K", 1.0)};
    c.fit.experiments = {experiment(folder, "step", csv)};
    c.fit.experiments[0].matches[0].column = column;
    const std::string text = refusal(c), path = folder / "step.csv";
    return text.starts_with(path) ? text.substr(path.size()) : text;
  };
  CHECK(complaint("time,y\n0,0\n1,nought\n") == ":3:3: error: expected a number, found \"nought\"");
  CHECK(complaint("time,y\n0,0\n1,1\n", "Y2") == ":1:1: error: there is no column \"Y2\"; known: time, y");
  CHECK(complaint("time,y\n0,0\n1,1\n0.5,2\n") == ":4:1: error: time falls from 1 s to 0.5 s");
  CHECK(complaint("time,y\n-1,0\n1,1\n") ==
        ":2:1: error: the data begin at -1 s, before the run, which begins at 0 s");
  CHECK(complaint("time,y\n0,0\n") == ":2:1: error: all data are at 0 s: nothing has happened there");
  CHECK_THAT(complaint("time,y [kg]\n0,0\n1,1\n"),
             Catch::StartsWith(":1:1: error: ") && Catch::Contains("kg"));
  FitCase missing = fit_case(lag);
  missing.fit.parameters = {from("K", 1.0)};
  missing.fit.experiments = {{"none", folder / "none.csv", {{"y", "y", 1.0}}, {}}};
  CHECK_THROWS_AS(missing.run(), FileError);
}
