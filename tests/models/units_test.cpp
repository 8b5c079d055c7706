#include "models/language/units.h"

#include <cmath>

#include "models/language/nearest.h"
#include "tests/catch.h"

using namespace flyball;

namespace {

// m, kg, s, A, K, mol, cd
struct Row {
  const char* text;
  double factor;
  Dimension dimension;
  Rational exact = Rational(0);  // 0: no fraction
};

Rational over(std::int64_t a, std::int64_t b) { return *Rational::fraction(a, b); }

}  // namespace

TEST_CASE("units stand for a factor and a dimension") {
  const double pi = std::acos(-1.0);
  const std::vector<Row> rows{
      {"1", 1.0, {}, 1},
      {"m", 1.0, {{1}}, 1},
      {"mm", 0.001, {{1}}, over(1, 1000)},
      {"km", 1000.0, {{1}}, 1000},
      {"um", 1e-6, {{1}}, over(1, 1'000'000)},
      {"\u00B5m", 1e-6, {{1}}, over(1, 1'000'000)},
      {"g", 0.001, {{0, 1}}, over(1, 1000)},
      {"kg", 1.0, {{0, 1}}, 1},
      {"s", 1.0, {{0, 0, 1}}, 1},
      {"ms", 0.001, {{0, 0, 1}}, over(1, 1000)},
      {"min", 60.0, {{0, 0, 1}}, 60},
      {"h", 3600.0, {{0, 0, 1}}, 3600},
      {"Hz", 1.0, {{0, 0, -1}}, 1},
      {"kHz", 1000.0, {{0, 0, -1}}, 1000},
      {"rpm", 2 * pi / 60, {{0, 0, -1}}},
      {"rad", 1.0, {}, 1},
      {"deg", pi / 180, {}},
      {"rev", 2 * pi, {}},
      {"%", 0.01, {}, over(1, 100)},
      {"N", 1.0, {{1, 1, -2}}, 1},
      {"J", 1.0, {{2, 1, -2}}, 1},
      {"W", 1.0, {{2, 1, -3}}, 1},
      {"Pa", 1.0, {{-1, 1, -2}}, 1},
      {"A", 1.0, {{0, 0, 0, 1}}, 1},
      {"V", 1.0, {{2, 1, -3, -1}}, 1},
      {"ohm", 1.0, {{2, 1, -3, -2}}, 1},
      {"\u03A9", 1.0, {{2, 1, -3, -2}}, 1},
      {"F", 1.0, {{-2, -1, 4, 2}}, 1},
      {"mH", 0.001, {{2, 1, -2, -2}}, over(1, 1000)},
      {"T", 1.0, {{0, 1, -2, -1}}, 1},
      {"K", 1.0, {{0, 0, 0, 0, 1}}, 1},
      {"degC", 1.0, {{0, 0, 0, 0, 1}}, 1},
      {"mol", 1.0, {{0, 0, 0, 0, 0, 1}}, 1},
      {"cd", 1.0, {{0, 0, 0, 0, 0, 0, 1}}, 1},
      {"L", 0.001, {{3}}, over(1, 1000)},
      {"kg*m^2", 1.0, {{2, 1}}, 1},
      {"m/s^2", 1.0, {{1, 0, -2}}, 1},
      {"1/s", 1.0, {{0, 0, -1}}, 1},
      {"kg*m^2/(s^2*A)", 1.0, {{2, 1, -2, -1}}, 1},
      {"m / s / s", 1.0, {{1, 0, -2}}, 1},
      {"mm^-2", 1e6, {{-2}}, 1'000'000},
      {"km/h", 1000.0 / 3600.0, {{1, 0, -1}}, over(5, 18)},
      {"deg/s", pi / 180, {{0, 0, -1}}},
  };
  for (const Row& row : rows) {
    CAPTURE(row.text);
    const Unit unit = parse_unit(row.text);
    // One rounding of the factor, and one of each product.
    CHECK(unit.factor == Approx(row.factor).epsilon(4e-16));
    CHECK(unit.dimension == row.dimension);
    CHECK(unit.exact == (row.exact == Rational(0) ? std::nullopt : std::optional(row.exact)));
  }
  CHECK(parse_unit("degC").offset == 273.15);
  CHECK(parse_unit("Hz").hertz);
  CHECK_FALSE(parse_unit("1/s").hertz);
}

TEST_CASE("SI units agree with their definitions") {
  const std::pair<const char*, const char*> pairs[] = {
      {"N", "kg*m/s^2"}, {"J", "N*m"},   {"W", "J/s"},    {"V", "W/A"},     {"ohm", "V/A"},
      {"F", "A*s/V"},    {"H", "V*s/A"}, {"Pa", "N/m^2"}, {"T", "V*s/m^2"}, {"L", "dm^3"}};
  for (const auto& [name, definition] : pairs) {
    CAPTURE(name);
    CHECK(parse_unit(name).dimension == parse_unit(definition).dimension);
    CHECK(parse_unit(name).exact == parse_unit(definition).exact);
  }
}

TEST_CASE("units that are wrong say where and what") {
  struct Wrong {
    const char* text;
    std::size_t offset;
    const char* message;
  };
  const Wrong all[] = {
      {"mmm", 0, "unknown unit \"mmm\"; did you mean \"mm\"?"},
      {"m/sek", 2, "unknown unit \"sek\""},
      {"kg*", 3, "expected the name of a unit"},
      {"kg m", 3, "expected *, / or ^ between units"},
      {"m^x", 2, "expected a whole exponent"},
      {"m/(s", 4, "expected \")\" to close the unit"},
      {"", 0, "expected the name of a unit"},
      {"J/degC", 0,
       "degC stands only as a whole value, such as \"21 degC\"; use K in expressions and compound units"},
      {"m^90*m^90", 0, "an exponent of the unit is too large"},
      {"kkg", 0, "unknown unit \"kkg\"; did you mean \"kg\"?"},
      {"kmin", 0, "unknown unit \"kmin\"; did you mean \"min\"?"},
  };
  for (const Wrong& wrong : all) {
    CAPTURE(wrong.text);
    try {
      parse_unit(wrong.text);
      FAIL_CHECK("no error");
    } catch (const TextError& error) {
      CHECK(error.offset() == wrong.offset);
      CHECK(std::string(error.what()) == wrong.message);
    }
  }
}

TEST_CASE("dimensions are written as units") {
  CHECK(to_string(parse_unit("N").dimension) == "N");
  CHECK(to_string(parse_unit("V").dimension) == "V");
  CHECK(to_string(parse_unit("rad").dimension) == "1");
  CHECK(to_string(parse_unit("Hz").dimension) == "1/s");
  // What is written is read back.
  for (const char* text : {"N", "V", "F", "m", "1/s", "mol/L", "cd*K"}) {
    const Dimension dimension = parse_unit(text).dimension;
    CHECK(parse_unit(to_string(dimension)).dimension == dimension);
  }
}

TEST_CASE("the nearest name is one or two slips away") {
  const std::vector<std::string> names{"Gain", "Integrator", "TransferFcn", "Sum"};
  CHECK(nearest("gian", names) == "Gain");
  CHECK(nearest("Intergrator", names) == "Integrator");
  CHECK(nearest("transferfcn", names) == "TransferFcn");
  CHECK(nearest("FluxCapacitor", names) == std::nullopt);
  CHECK(nearest("", names) == std::nullopt);
  CHECK(edit_distance("abcd", "acbd") == 1);
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("Kitten", "sitting") == 3);
}
