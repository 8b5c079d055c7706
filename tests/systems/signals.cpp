// Sources and mathematics in a diagram: what happens in time, by two methods.
#include <cmath>

#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

namespace {

std::string with_method(const std::string& text, const std::string& method) {
  return text + "solver = { method = \"" + method + "\", rtol = 1e-10, atol = 1e-12 }\n";
}

// Of some hundred steps, each with an error of the tolerance, and ten times as much to spare.
constexpr double hundreds_of_steps = 1e-7;

}  // namespace

TEST_CASE("Ramp: its integral is a parabola from its start on") {
  for (const std::string method : {"dp5", "bdf"}) {
    INFO(method);
    Run run(with_method(R"toml(
flyball = 1
[blocks]
ramp = { type = "Ramp", slope = 3.0, start = "0.7 s", initial = 1.0 }
x = { type = "Integrator" }
[diagram]
wires = ["ramp -> x"]
[simulation]
stop = "2 s"
)toml",
                        method));
    run.finish();
    CHECK(std::fabs(run["x.x"] - (2.0 + 1.5 * 1.3 * 1.3)) < hundreds_of_steps);
  }
}

TEST_CASE("Sign, MinMax and Counter: kinks are located") {
  for (const std::string method : {"dp5", "adams"}) {
    INFO(method);
    Run run(with_method(R"toml(
flyball = 1
[blocks]
sine = { type = "SineWave" }
cosine = { type = "SineWave", phase = "90 deg" }
greatest = { type = "MinMax", function = "max", inputs = 2 }
area = { type = "Integrator" }
sign = { type = "Sign" }
signed = { type = "Integrator" }
turns = { type = "Counter", threshold = 0.0, direction = "either" }
[diagram]
wires = ["sine -> greatest.u1", "cosine -> greatest.u2", "greatest -> area", "cosine -> sign -> signed", "cosine -> turns"]
[simulation]
stop = "10 s"
)toml",
                        method));
    run.finish();
    // sin is the greater one from pi/4 to 5 pi/4, cos up to 9 pi/4, sin up to 10 (< 13 pi/4).
    const double root2 = std::sqrt(2.0);
    const double area = root2 / 2 + root2 + root2 + (root2 / 2 - std::cos(10.0));
    CHECK(std::fabs(run["area.x"] - area) < hundreds_of_steps);
    // cos changes its sign at pi/2, 3 pi/2 and 5 pi/2.
    CHECK(std::fabs(run["signed.x"] - (M_PI_2 - M_PI + M_PI - (10.0 - 5 * M_PI_2))) < hundreds_of_steps);
    CHECK(run["turns.count"] == 3.0);
  }
}
