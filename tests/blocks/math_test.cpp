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

}  // namespace flyball::test
