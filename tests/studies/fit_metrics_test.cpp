#include <cmath>

#include "tests/catch.h"
#include "tests/studies/fit_case.h"

using namespace flyball;
using namespace flyball::test;

namespace {

/// The step response of 1/(s^2 + 2 zeta s + 1), with criteria of its error as states of the model.
const std::string oscillator = R"toml(
flyball = 1
[parameters]
zeta = { value = 1.0, range = [0.0, 5.0] }
[blocks]
x = { type = "Integrator", initial = -1.0 }
v = { type = "Integrator", initial = 0.0 }
force = { type = "Expression", inputs = ["x", "v"], formula = "-x - 2*zeta*v" }
t = { type = "Clock" }
square = { type = "Expression", inputs = ["x"], formula = "x^2" }
late = { type = "Expression", inputs = ["x", "t"], formula = "t*abs(x)" }
ise = { type = "Integrator" }
itae = { type = "Integrator" }
[diagram]
wires = ["v -> x", "x -> force.x, square, late.x", "v -> force.v", "force -> v", "t -> late.t", "square -> ise", "late -> itae"]
log = ["x", "v", "ise", "itae"]
[simulation]
stop = 60
log_interval = "10 ms"
)toml";

void add_metric(FitCase& c, const std::string& name, const std::string& text) {
  c.study.metrics.emplace_back(name, text);
  c.study.models[0].metrics.emplace_back(text, c.plan().columns);
}

FitResult least(const std::string& metric, double start) {
  FitCase c = fit_case(oscillator);
  add_metric(c, "criterion", metric);
  c.fit.minimise = {0};
  c.fit.parameters = {from("zeta", start)};
  const FitResult result = c.run();
  INFO(metric << " from " << start << ": " << result.reason << " after " << result.iterations);
  CHECK(result.converged);
  CHECK(result.gradient == "numeric");
  CHECK(remarks_contain(result, "there are no data, so there are no standard errors"));
  return result;
}

}  // namespace

TEST_CASE("Fit: the least integral of the squared error is at a damping of 0.5, and is 1") {
  for (const double start : {0.2, 1.0, 3.0}) {
    const FitResult result = least("final(ise)", start);
    // J = zeta + 1/(4 zeta): a central difference over 3e-4 of 0.5 moves its zero by 2e-8, noise of the runs
    // (1e-10 and more) by less than 1e-6.
    CHECK(std::fabs(found(result, "zeta").value - 0.5) < 2e-6);
    CHECK(std::fabs(2.0 * result.cost - 1.0) < 1e-7);
  }
  // By the rows of the log, too: what the trapezoids of 10 ms leave is below 1e-5.
  CHECK(std::fabs(found(least("integral(x^2)", 1.0), "zeta").value - 0.5) < 1e-5);
}

TEST_CASE(
    "Fit: the least integral of time and absolute error is at a damping of 0.7524441, and is 1.951859") {
  const FitResult result = least("final(itae)", 1.0);
  // The closed form between zeros of x has its minimum at 0.752444093; 0.752442, which is quoted, is as good
  // to ten digits of the integral.
  CHECK(std::fabs(found(result, "zeta").value - 0.752444093) < 1e-6);
  CHECK(std::fabs(found(result, "zeta").value - 0.752442) < 3e-6);
  CHECK(std::fabs(2.0 * result.cost - 1.951859456) < 1e-7);
}

TEST_CASE("Fit: a requirement pulls until it holds, beside data and metrics") {
  FitCase c = fit_case(oscillator);
  c.study.requirements.emplace_back("fast", "max(v) > 0.6");
  c.study.models[0].requirements.emplace_back("max(v) > 0.6", c.plan().columns, ".");
  c.fit.requirements = {0};
  c.fit.parameters = {from("zeta", 1.0)};
  const FitResult result = c.run();
  CHECK(result.converged);
  CHECK(result.cost < 1e-16);
  CHECK(found(result, "zeta").value < 0.6);
  // One that holds asks for nothing.
  c.fit.parameters = {from("zeta", 0.1)};
  CHECK(found(c.run(), "zeta").value == 0.1);

  FitCase negative = fit_case(oscillator);
  add_metric(negative, "below", "final(ise) - 100");
  negative.fit.minimise = {0};
  negative.fit.parameters = {from("zeta", 1.0)};
  CHECK_THAT(negative.run().reason, Catch::Contains("the metric below is -9"));
}
