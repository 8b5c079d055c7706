#include "models/language/expression.h"

#include <cmath>

#include "models/language/quantity.h"
#include "tests/catch.h"

using namespace flyball;

namespace {

const NameIndex parameters{{"V", 0}, {"L", 1}, {"n", 2}};
constexpr double V = 12.5, L = 0.25, n = 3.0;
const double pi = std::acos(-1.0);

double value(std::string_view text) {
  const Formula formula = parse_expression(text, Scope{&parameters, {}});
  std::vector<double> operands;
  for (const std::string& name : formula.operands) operands.push_back(name == "V" ? V : name == "L" ? L : n);
  return evaluate(formula, operands);
}

std::optional<Rational> exact(std::string_view text) {
  const Formula formula = parse_expression(text, Scope{&parameters, {}});
  std::vector<std::optional<Rational>> operands;
  for (const std::string& name : formula.operands) {
    operands.push_back(name == "V"   ? *Rational::fraction(25, 2)
                       : name == "L" ? *Rational::fraction(1, 4)
                                     : Rational(3));
  }
  return evaluate_exact(formula, operands);
}

Rational over(std::int64_t a, std::int64_t b) { return *Rational::fraction(a, b); }

Quantity quantity(std::string_view text) {
  const Formula formula = parse_expression(text, Scope{&parameters, {}});
  std::vector<Quantity> operands;
  for (const std::string& name : formula.operands) {
    operands.push_back(name == "V" ? Quantity("m/s") : name == "L" ? Quantity("m") : Quantity("any"));
  }
  return infer(formula, operands);
}

/// "offset: message" of what is wrong with a text; "" if nothing is.
std::string wrong(std::string_view text) {
  try {
    quantity(text);
    return "";
  } catch (const TextError& error) {
    return std::to_string(error.offset()) + ": " + error.what();
  }
}

}  // namespace

TEST_CASE("expressions have the value that C++ gives them") {
  const std::pair<const char*, double> all[] = {
      {"1 + 2*3", 1 + 2.0 * 3},
      {"(1 + 2)*3", (1.0 + 2) * 3},
      {"2 - 3 - 4", 2.0 - 3 - 4},
      {"2/4/8", 2.0 / 4 / 8},
      {"2/4*8", 2.0 / 4 * 8},
      {"-2^2", -4},
      {"(-2)^2", 4},
      {"2^-2", 0.25},
      {"2^3^2", 512},
      {"-V^2", -(V * V)},
      {"2^-n", std::pow(2.0, -n)},
      {"V^(1/2)", std::pow(V, 0.5)},
      {"(-8)^n", std::pow(-8.0, 3)},
      {"+V - -L", V + L},
      {"--V", V},
      {"1e3 + .5 + 2.", 1000 + 0.5 + 2},
      {"1.5e-3*2E+2", 1.5e-3 * 2e2},
      {"pi + e", pi + std::exp(1.0)},
      {"sin(V) + cos(L) + tan(L)", std::sin(V) + std::cos(L) + std::tan(L)},
      {"asin(L) + acos(L) + atan(V)", std::asin(L) + std::acos(L) + std::atan(V)},
      {"atan2(V, -L)", std::atan2(V, -L)},
      {"sinh(L) + cosh(L) + tanh(L)", std::sinh(L) + std::cosh(L) + std::tanh(L)},
      {"exp(L) + log(V) + log10(V)", std::exp(L) + std::log(V) + std::log10(V)},
      {"sqrt(V) + hypot(V, L)", std::sqrt(V) + std::hypot(V, L)},
      {"abs(-V) + abs(V) + abs(0)", 2 * V},
      {"sign(-V) + 10*sign(L) + 100*sign(0)", 9},
      {"min(V, L) + 10*max(V, L)", L + 10 * V},
      {"min(2, 2) + max(3, 3)", 5},
      {"if(V > L, 1, 2)", 1},
      {"if(V < L, 1, 2)", 2},
      {"if(V >= V, 1, 2)", 1},
      {"if(V <= V, 1, 2)", 1},
      {"if(V > V, 1, 2)", 2},
      {"if(V < V, 1, 2)", 2},
      {"if(V >= L and not V <= L, 1, 2)", 1},
      {"if(V < L or L < V and n > 5, 1, 2)", 2},
      {"if((V < L or L < V) and n < 5, 1, 2)", 1},
      {"if(not (V < L or V > L), 1, 2)", 2},
      {"2 * if(V > 1, V, L) ^ 2", 2 * V * V},
  };
  for (const auto& [text, expected] : all) {
    CAPTURE(text);
    // The same operations in the same order: at most the last bit of a library function may differ.
    CHECK(value(text) == Approx(expected).epsilon(2.3e-16));
  }
}

TEST_CASE("numbers carry units") {
  const std::pair<const char*, double> all[] = {
      {"54 mm", 0.054},
      {"54mm", 0.054},
      {"3 ms", 0.003},
      {"2 kg*m^2", 2},
      {"0.5 deg/s", 0.5 * pi / 180},
      {"30 rpm", pi},
      {"20 %", 0.2},
      {"5 min", 300},
      {"0.5 1/s", 0.5},
      {"2 mm^2 + 1 cm^2", 0.000102},
      {"1/3 s", 1.0 / 3},
      {"V/3 s", V / 3},
      {"1/3 ms*2", 2.0 / 3000},
      {"36 km/h", 10},
      {"2 kg/(m*s)", 2},
      {"2 m*(1 + 1)", 4},
      {"2 m/2", 1},
      {"2 m*min(V, 3)", 6},
      {"21 degC", 294.15},
      {"-5 degC", 268.15},
      {" +5degC ", 278.15},
      {"-2 mm^2", -2e-6},
  };
  for (const auto& [text, expected] : all) {
    CAPTURE(text);
    // A decimal with a decimal prefix is rounded once; irrational factors round twice.
    CHECK(value(text) == Approx(expected).epsilon(2.3e-16));
  }
  // Rounded once means the very same double as the literal.
  CHECK(value("54 mm") == 0.054);
  CHECK(value("3 ms") == 0.003);
  CHECK(value("0.7 mm") == 0.0007);
}

TEST_CASE("a unit ends at the first name that is a parameter") {
  CHECK(value("2 m*V") == 2 * V);
  CHECK(value("2 kg*V/L") == 2 * V / L);
  CHECK(value("2 m/n") == 2 / n);
  CHECK(value("2 kg*m") == 2);
  // With inputs of the same name, too.
  const std::vector<std::string> inputs{"s"};
  const Formula formula = parse_expression("2 m/s", Scope{&parameters, inputs});
  CHECK(formula.operands == inputs);
}

TEST_CASE("exact values are fractions") {
  CHECK(exact("10 ms") == over(1, 100));
  CHECK(exact("1/3 s") == over(1, 3));
  CHECK(exact("0.1") == over(1, 10));
  CHECK(exact("1e-9") == over(1, 1'000'000'000));
  CHECK(exact("-2.50") == over(-5, 2));
  CHECK(exact("1/3 + 1/6") == over(1, 2));
  CHECK(exact("2*V/n") == over(25, 3));
  CHECK(exact("(2/3)^-2") == over(9, 4));
  CHECK(exact("if(V > 12, L, n)") == over(1, 4));
  CHECK(exact("min(V, L)*max(1, 2)") == over(1, 2));
  CHECK(exact("abs(-n)") == Rational(3));
  CHECK(exact("1 min + 1/2 s") == over(121, 2));
  CHECK(exact("sqrt(4)") == std::nullopt);
  CHECK(exact("pi") == std::nullopt);
  CHECK(exact("1 deg") == std::nullopt);
  CHECK(exact("1/0") == std::nullopt);
  CHECK(exact("1e-30") == std::nullopt);
  CHECK(exact("2^100") == std::nullopt);
}

TEST_CASE("exact decimals fit 64 bits or are none") {
  CHECK(exact_decimal("0.1") == over(1, 10));
  CHECK(exact_decimal("1e3") == Rational(1000));
  CHECK(exact_decimal("-1.25E-2") == over(-1, 80));
  CHECK(exact_decimal("0e99") == Rational(0));
  CHECK(exact_decimal("3.14159265358979323846264338") == std::nullopt);
  CHECK(exact_decimal("nan") == std::nullopt);
}

TEST_CASE("each kink is a comparison") {
  const auto formula = [](std::string_view text) { return parse_expression(text, Scope{&parameters, {}}); };
  CHECK(formula("V + L").comparisons == 0);
  CHECK(formula("min(V, L)").comparisons == 1);
  CHECK(formula("abs(V)").comparisons == 1);
  CHECK(formula("sign(V)").comparisons == 2);
  CHECK(formula("if(V > 1 and V < 2, 1, 2)").comparisons == 2);
  // Numbered without gaps, since the engine keeps a bit for each.
  const Formula two = formula("max(V, min(L, n))");
  std::vector<int> numbers;
  for (const Formula::Node& node : two.nodes) {
    if (node.op == Formula::Op::greater) numbers.push_back(node.index);
  }
  CHECK(numbers == std::vector<int>{0, 1});
}

TEST_CASE("arguments stand before their users, literals keep what was written") {
  const Formula formula = parse_expression("3*V + 5 mm", Scope{&parameters, {}});
  for (std::size_t k = 0; k < formula.nodes.size(); ++k) {
    for (const int argument : formula.nodes[k].argument) CHECK(argument < static_cast<int>(k));
  }
  REQUIRE(formula.nodes.size() == 5);
  CHECK(formula.text == "3*V + 5 mm");
  CHECK(formula.nodes[0].exact == Rational(3));
  CHECK_FALSE(formula.nodes[0].dimension.has_value());
  CHECK(formula.nodes[3].offset == 6);
  CHECK(formula.nodes[3].exact == over(1, 200));
  CHECK(formula.nodes[3].dimension == parse_unit("m").dimension);
  // An exponent is one literal, so that the base may be negative on every scalar.
  const Formula power = parse_expression("V^(3/2)", Scope{&parameters, {}});
  CHECK(power.nodes[power.nodes.back().argument[1]].op == Formula::Op::literal);
  CHECK(power.nodes[power.nodes.back().argument[1]].exact == over(3, 2));
}

TEST_CASE("the dimension of an expression is known where its parts are") {
  using Kind = Quantity::Kind;
  const std::pair<const char*, const char*> known[] = {
      {"V", "m/s"},         {"2*V", "m/s"},     {"V/L", "1/s"},           {"V*L", "m^2/s"},
      {"V^2", "m^2/s^2"},   {"sqrt(L^2)", "m"}, {"L + 1", "m"},           {"1 - L", "m"},
      {"max(L, 0)", "m"},   {"abs(V)", "m/s"},  {"if(n > 1, L, n)", "m"}, {"V*sin(L/(2 m))", "m/s"},
      {"hypot(L, L)", "m"}, {"90 deg", "1"},    {"1/(2 ms)", "1/s"},      {"L^(3/2)*L^(1/2)*0 + 3 m", "m"}};
  for (const auto& [text, unit] : known) {
    CAPTURE(text);
    const Quantity found = quantity(text);
    CHECK(found.kind == Kind::known);
    CHECK(found.dimension == parse_unit(unit).dimension);
  }
  for (const char* text : {"2", "2*3 + pi", "sin(1)", "atan2(L, 3 m)", "exp(2)^2"}) {
    CAPTURE(text);
    CHECK(quantity(text).kind == Kind::free);
  }
  for (const char* text : {"n", "n*L", "L/n", "sqrt(L)", "2^n*n"}) {
    CAPTURE(text);
    CHECK(quantity(text).kind == Kind::unknown);
  }
}

TEST_CASE("dimensions that contradict each other are refused where they meet") {
  CHECK(wrong("L + V") == "2: m and m/s cannot be added or compared");
  CHECK(wrong("3*(L - 1 s)") == "5: m and s cannot be added or compared");
  CHECK(wrong("if(L > V, 1, 2)") == "5: m and m/s cannot be added or compared");
  CHECK(wrong("if(n > 1, L, V)") == "0: m and m/s cannot be added or compared");
  CHECK(wrong("sin(L)") == "4: expected a plain number, found m");
  CHECK(wrong("2^(3*L)") == "4: expected a plain number, found m");
  CHECK(wrong("atan2(L, V)") == "0: m and m/s cannot be added or compared");
  CHECK(wrong("n + V") == "");
  CHECK(wrong("2 \u00B5x").find("2: unknown unit \"\u00B5x\"") == 0);
  CHECK(wrong("3 \u00D7 4") == "2: unexpected \"\u00D7\"");
}

TEST_CASE("hertz is no rad/s") {
  const std::string refusal = "expected rad/s, found Hz, which lacks a factor of 2*pi: write \"2*pi*50 Hz\"";
  CHECK(misfit(quantity("50 Hz"), "rad/s") == refusal);
  CHECK(misfit(quantity("2*50 Hz"), "rad/s") == refusal);
  CHECK(misfit(quantity("-(1 kHz + 2 Hz)"), "rad/s") == refusal);
  CHECK(misfit(quantity("2*pi*50 Hz"), "rad/s") == std::nullopt);
  CHECK(misfit(quantity("50 Hz*2*pi"), "rad/s") == std::nullopt);
  CHECK(misfit(quantity("50 Hz"), "Hz") == std::nullopt);
  CHECK(misfit(quantity("50 Hz"), "1/s") == std::nullopt);
  CHECK(misfit(quantity("300 rpm"), "rad/s") == std::nullopt);
  CHECK(misfit(quantity("1/(50 Hz)"), "s") == std::nullopt);
}

TEST_CASE("a misfit names both dimensions") {
  CHECK(misfit(quantity("V"), "m") == "expected m, found m/s");
  CHECK(misfit(quantity("V"), "N") == "expected N, found m/s");
  CHECK(misfit(quantity("V"), "1") == "expected a plain number, found m/s");
  CHECK(misfit(quantity("30 deg"), "m") == "expected m, found a plain number");
  CHECK(misfit(quantity("V"), "any") == std::nullopt);
  CHECK(misfit(quantity("3"), "m") == std::nullopt);
  CHECK(misfit(quantity("n"), "m") == std::nullopt);
}
