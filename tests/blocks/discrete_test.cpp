// Sampled blocks and counters, hit by hit.
#include "tests/blocks/bench.h"
#include "tests/catch.h"

namespace flyball::test {
namespace {

using namespace std::string_literals;

/// The outputs at the hits with these inputs.
std::vector<double> response(Device& d, const std::vector<double>& inputs) {
  std::vector<double> outputs;
  for (const double u : inputs) {
    d["u"] = u;
    outputs.push_back(d.hit("y"));
  }
  return outputs;
}

const Rational half = *Rational::fraction(1, 2);

}  // namespace

TEST_CASE("Delay gives its input as many hits later, after its initial values") {
  Device one("Delay", {{"sample_time", half}, {"length", 3.0}, {"initial", 7.0}});
  CHECK(response(one, {1.0, 2.0, 3.0, 4.0, 5.0}) == std::vector{7.0, 7.0, 7.0, 1.0, 2.0});
  Device each("Delay", {{"sample_time", half}, {"length", 2.0}, {"initial_values", Numbers{-1.0, 0.0}}});
  CHECK(response(each, {1.0, 2.0, 3.0}) == std::vector{-1.0, 0.0, 1.0});
}

TEST_CASE("DiscreteTimeIntegrator adds the areas of its rule") {
  const auto integral = [](const std::string& method) {
    Device d("DiscreteTimeIntegrator",
             {{"sample_time", half}, {"method", method}, {"gain", 4.0}, {"initial", 10.0}});
    return response(d, {1.0, 3.0, -2.0, 0.0});
  };
  // gain * sample_time = 2
  CHECK(integral("forward") == std::vector{10.0, 12.0, 18.0, 14.0});
  CHECK(integral("backward") == std::vector{12.0, 18.0, 14.0, 14.0});
  CHECK(integral("trapezoidal") == std::vector{11.0, 15.0, 16.0, 14.0});
}

TEST_CASE("DiscreteTimeIntegrator stays within its limits, and leaves them at once") {
  for (const char* method : {"forward", "backward", "trapezoidal"}) {
    INFO(method);
    Device d("DiscreteTimeIntegrator", {{"sample_time", half},
                                        {"method", std::string(method)},
                                        {"lower", -1.0},
                                        {"upper", 2.0},
                                        {"initial", 5.0}});
    for (const double y : response(d, {8.0, 8.0, 8.0, 8.0})) CHECK(y == 2.0);
    d["u"] = -2.0;
    d.hit("y");
    d["u"] = 0.0;
    // One hit of -2 for 0.5 s; the trapezoidal rule first counted its half of 8.
    CHECK(d.hit("y") == 1.0);
    for (int k = 0; k < 5; ++k) {
      d["u"] = -8.0;
      d.hit("y");
    }
    CHECK(d.update()["y"] == -1.0);
  }
}

TEST_CASE("DiscreteTimeIntegrator starts again from its initial value at the edge that was asked for") {
  const auto integral = [](const std::string& reset) {
    Device d("DiscreteTimeIntegrator", {{"sample_time", Rational(1)}, {"reset", reset}, {"initial", 100.0}});
    std::vector<double> outputs;
    for (const double trigger : {0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0}) {
      d["u"] = 1.0, d["reset"] = trigger;
      outputs.push_back(d.hit("y"));
    }
    return outputs;
  };
  CHECK(integral("rising") == std::vector{100.0, 101.0, 100.0, 101.0, 102.0, 103.0, 100.0});
  CHECK(integral("falling") == std::vector{100.0, 101.0, 102.0, 103.0, 100.0, 101.0, 102.0});
  CHECK(integral("either") == std::vector{100.0, 101.0, 100.0, 101.0, 100.0, 101.0, 100.0});
}

TEST_CASE("DiscreteTransferFcn obeys its difference equation") {
  // 2 y(k) = y(k-1) - 4 y(k-2) + 3 u(k-1) + 5 u(k-2)
  Device d(
      "DiscreteTransferFcn",
      {{"sample_time", half}, {"numerator", Numbers{3.0, 5.0}}, {"denominator", Numbers{2.0, -1.0, 4.0}}});
  const std::vector u{1.0, -2.0, 0.5, 3.0, 0.0, 0.0, 1.0};
  const std::vector<double> y = response(d, u);
  for (int k = 0; k < static_cast<int>(u.size()); ++k) {
    const auto at = [&](const std::vector<double>& signal, int j) { return j < 0 ? 0.0 : signal[j]; };
    const double expected =
        (at(y, k - 1) - 4.0 * at(y, k - 2) + 3.0 * at(u, k - 1) + 5.0 * at(u, k - 2)) / 2.0;
    // All numbers are multiples of 2^-8 below 1000: no rounding.
    CHECK(y[k] == expected);
  }
}

TEST_CASE("DiscreteStateSpace obeys x(k+1) = A x(k) + B u(k), y(k) = C x(k) + D u(k)") {
  Device d("DiscreteStateSpace", {{"sample_time", half},
                                  {"A", Table{{0.0, 1.0}, {-0.5, 0.25}}},
                                  {"B", Table{{1.0}, {2.0}}},
                                  {"C", Table{{3.0, -1.0}}},
                                  {"D", Table{{0.5}}},
                                  {"initial", Numbers{4.0, -2.0}}});
  double x1 = 4.0, x2 = -2.0;
  for (const double u : {1.0, 0.0, -3.0, 2.0}) {
    d["u"] = u;
    CHECK(d.hit("y") == 3.0 * x1 - x2 + 0.5 * u);
    const double next1 = x2 + u;
    x2 = -0.5 * x1 + 0.25 * x2 + 2.0 * u;
    x1 = next1;
  }
}

TEST_CASE("CounterLimited counts hits from 0 to its limit and begins again") {
  Device d("CounterLimited", {{"sample_time", half}, {"upper", 2.0}});
  std::vector<double> counts;
  for (int k = 0; k < 7; ++k) counts.push_back(d.hit("y"));
  CHECK(counts == std::vector{0.0, 1.0, 2.0, 0.0, 1.0, 2.0, 0.0});
}

TEST_CASE("Counter counts edges, and starts again at a reset") {
  Device d("Counter", {{"initial", 5.0}, {"reset", true}});
  d["u"] = 0.75;
  d.update();
  CHECK(d["edge"] == 0.25);
  d.handle(Phase::crossing, "edge");
  d.handle(Phase::crossing, "edge");
  CHECK(d["y"] == 7.0);
  d.handle(Phase::crossing, "clear");
  CHECK(d["y"] == 5.0);
}

}  // namespace flyball::test
