#include "tests/blocks/bench.h"
#include "tests/catch.h"

namespace flyball::test {

using namespace std::string_literals;

TEST_CASE("Gain multiplies") {
  Device d("Gain", {{"gain", -2.5}});
  d["u"] = 4.0;
  CHECK(d.update()["y"] == -10.0);
}

TEST_CASE("Sum adds and subtracts by its signs") {
  Device d("Sum", {{"signs", "+--"s}});
  d["u1"] = 8.0, d["u2"] = 2.0, d["u3"] = 1.0;
  CHECK(d.update()["y"] == 5.0);
}

TEST_CASE("Product multiplies and divides by its signs") {
  Device d("Product", {{"signs", "/**"s}});
  d["u1"] = 8.0, d["u2"] = 2.0, d["u3"] = 3.0;
  CHECK(d.update()["y"] == 0.75);
}

TEST_CASE("Abs is the distance from 0 on both sides") {
  Device d("Abs");
  for (const double u : {-3.0, 0.0, 2.0}) {
    d["u"] = u;
    CHECK(d.update()["y"] == std::fabs(u));
  }
}

TEST_CASE("TrigonometricFunction is the function that it names") {
  const std::vector<std::pair<std::string, double (*)(double)>> functions{
      {"sin", std::sin},   {"cos", std::cos},   {"tan", std::tan},   {"asin", std::asin}, {"acos", std::acos},
      {"atan", std::atan}, {"sinh", std::sinh}, {"cosh", std::cosh}, {"tanh", std::tanh}};
  for (const auto& [name, function] : functions) {
    Device d("TrigonometricFunction", {{"function", name}});
    d["u"] = 0.7;
    INFO(name);
    CHECK(d.update()["y"] == function(opaque(0.7)));
  }
  Device d("TrigonometricFunction", {{"function", "atan2"s}});
  d["u1"] = -1.0, d["u2"] = -2.0;
  CHECK(d.update()["y"] == std::atan2(opaque(-1.0), opaque(-2.0)));
}

TEST_CASE("Divide divides u1 by u2") {
  Device d("Divide");
  d["u1"] = 3.0, d["u2"] = -8.0;
  CHECK(d.update()["y"] == -0.375);
}

TEST_CASE("Sign is 1, -1, and 0 for a signal that was never anything else") {
  Device d("Sign");
  CHECK(d.update()["y"] == 0.0);
  for (const double u : {3.0, -0x1p-1074, 0x1p-1074}) {
    d["u"] = u;
    CHECK(d.update()["y"] == std::copysign(1.0, u));
  }
  // Zero changes nothing: a signal that comes to rest at 0 keeps the sign that it came with.
  d["u"] = 0.0;
  CHECK(d.update()["y"] == 1.0);
}

TEST_CASE("MinMax finds the extreme of its inputs in every order of them") {
  std::vector<double> values{-2.0, 0.5, 0.5, 7.0};
  Device least("MinMax", {{"inputs", 4.0}}),
      greatest("MinMax", {{"inputs", 4.0}, {"function", std::string("max")}});
  do {
    for (int k = 0; k < 4; ++k) {
      const std::string port = "u" + std::to_string(k + 1);
      least[port] = greatest[port] = values[k];
    }
    REQUIRE(least.update()["y"] == -2.0);
    REQUIRE(greatest.update()["y"] == 7.0);
  } while (std::ranges::next_permutation(values).found);
}

TEST_CASE("MathFunction computes each of its functions") {
  const auto of = [](const std::string& function, double u) {
    Device d("MathFunction", {{"function", function}});
    d["u"] = u;
    return d.update()["y"];
  };
  CHECK(of("exp", 1.25) == std::exp(opaque(1.25)));
  CHECK(of("log", 1.25) == std::log(opaque(1.25)));
  CHECK(of("log10", 1000.0) == 3.0);
  CHECK(of("10^u", 3.0) == 1000.0);
  CHECK(of("square", -1.5) == 2.25);
  CHECK(of("sqrt", 2.25) == 1.5);
  CHECK(of("reciprocal", -4.0) == -0.25);
  const auto of_two = [](const std::string& function, double u1, double u2) {
    Device d("MathFunction", {{"function", function}});
    d["u1"] = u1, d["u2"] = u2;
    return d.update()["y"];
  };
  CHECK(of_two("pow", 2.0, -3.0) == 0.125);
  CHECK(of_two("hypot", 3.0, -4.0) == 5.0);
}

TEST_CASE("MathFunction: remainders and the whole parts that their crossings keep") {
  const auto remainder = [](const std::string& function, double u1, double u2) {
    Device d("MathFunction", {{"function", function}});
    d["u1"] = u1, d["u2"] = u2;
    d.update();
    if (d["up"] > 0.0) d.handle(Phase::crossing, "up");
    if (d["down"] < 0.0) d.handle(Phase::crossing, "down");
    d.update();
    // Settled: the next whole parts are on both sides.
    CHECK((d["up"] <= 0.0 && d["down"] >= 0.0));
    return d["y"];
  };
  for (const double u1 : {-7.5, -6.0, -1.0, -0.25, 0.0, 0.25, 1.0, 6.0, 7.5}) {
    for (const double u2 : {2.0, -2.0, 0.5}) {
      INFO(u1 << " by " << u2);
      CHECK(remainder("rem", u1, u2) == std::fmod(u1, u2));
      CHECK(remainder("mod", u1, u2) == u1 - std::floor(u1 / u2) * u2);
    }
  }
}

}  // namespace flyball::test
