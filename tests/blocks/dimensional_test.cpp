// What the equations of blocks demand of units. Each demand reads "1 = …": the product on the right has no
// unit. That fixes dimensions only up to a common exponent, so the first name always stands once.
#include <fmt/format.h>

#include "blocks/dimensional.h"
#include "tests/blocks/bench.h"
#include "tests/blocks/formulas.h"
#include "tests/catch.h"

namespace flyball::test {
namespace {

std::string name_of(int unknown, const Specification& spec) {
  constexpr std::array<const char*, base_units> units{"[m]", "[kg]", "[s]", "[A]", "[K]", "[mol]", "[cd]"};
  if (unknown < 0) return fmt::format("#{}", -1 - unknown);
  return unknown < base_units ? units[unknown] : spec.slots[unknown - base_units].name;
}

std::string text(const LinearForm& form, const Specification& spec) {
  std::string result;
  for (const auto& [unknown, coefficient] : form.terms()) {
    result += fmt::format("{}{}", result.empty() ? "" : " ", name_of(unknown, spec));
    if (coefficient == Rational(1)) continue;
    result += fmt::format("^{}", coefficient.numerator());
    if (coefficient.denominator() != 1) result += fmt::format("/{}", coefficient.denominator());
  }
  return result;
}

std::vector<std::string> demands(const std::string& type, Keys keys = {}) {
  const BlockObject object = create(type, std::move(keys));
  std::vector<std::string> all;
  for (const DimensionEquation& equation : object.dimensions) {
    all.push_back(text(equation.form, *object.specification));
  }
  return all;
}

using Demands = std::vector<std::string>;

constexpr auto equal = DimensionEquation::Kind::equal;
constexpr auto number = DimensionEquation::Kind::number;

std::vector<DimensionEquation> recorded(auto&& equation) {
  DimensionRecorder recorder;
  equation(Dimensional(7, recorder), Dimensional(8, recorder));
  return recorder.take();
}

LinearForm form(std::initializer_list<std::pair<int, Rational>> terms) {
  LinearForm result;
  for (const auto& [unknown, coefficient] : terms) REQUIRE(result.add(LinearForm(unknown), coefficient));
  return result;
}

LinearForm x_over_y() { return form({{7, 1}, {8, -1}}); }

}  // namespace

TEST_CASE("products add exponents, and roots halve them") {
  DimensionRecorder recorder;
  const Dimensional x(7, recorder), y(8, recorder);
  CHECK(*(x * y / (y * y)).form() == x_over_y());
  CHECK(*sqrt(x * x * y).form() == form({{7, 1}, {8, *Rational::fraction(1, 2)}}));
  CHECK(*pow(x, 1.0 / 3.0).form() == form({{7, *Rational::fraction(1, 3)}}));
  CHECK(*(2.0 * x / 3.0).form() == form({{7, 1}}));
  CHECK(*hypot(x, x).form() == form({{7, 1}}));
  CHECK(recorder.take().empty());
}

TEST_CASE("sums, choices and limits demand equal dimensions, functions plain numbers") {
  const std::vector<DimensionEquation> same{{equal, x_over_y()}};
  CHECK(recorded([](auto x, auto y) { x + y; }) == same);
  CHECK(recorded([](auto x, auto y) { return x -= y; }) == same);
  CHECK(recorded([](auto x, auto y) { return select(true, x, y); }) == same);
  CHECK(recorded([](auto x, auto y) { return min(x, y); }) == same);
  CHECK(recorded([](auto x, auto y) { return max(x, y); }) == same);
  CHECK(recorded([](auto x, auto y) { return clamp(x, y, y); }) == same);
  CHECK(recorded([](auto x, auto y) { return sin(atan2(x, y)); }) == same);
  const std::vector<DimensionEquation> plain{{number, form({{7, 1}})}};
  CHECK(recorded([](auto x, auto) { return exp(-x); }) == plain);
  CHECK(recorded([](auto x, auto) { return wrap(sin(x)); }) == plain);
  CHECK(recorded([](auto x, auto) { return pow(2.0, x); }) == plain);
  CHECK(recorded([](auto x, auto y) { return pow(x, y); }) ==
        std::vector<DimensionEquation>{{number, form({{7, 1}})}, {number, form({{8, 1}})}});
}

TEST_CASE("a literal takes the dimension of what it is added to, and 0 fits anything") {
  CHECK(recorded([](auto x, auto) { x + 1.0; }).empty());
  CHECK(recorded([](auto x, auto y) { return (1.0 + x) + y; }).size() == 1);
  CHECK(recorded([](auto x, auto y) { return 0.0 * x + y; }).empty());
  CHECK(recorded([](auto x, auto) { return select(true, never, x); }).empty());
  CHECK(recorded([](auto, auto) { return sin(2.0) + exp(1.0); }).empty());
  CHECK(Dimensional(3.0).form() == nullptr);
}

TEST_CASE("a literal of a text is an unknown factor, one with a unit is unknown everywhere") {
  DimensionRecorder recorder;
  const Dimensional x(7, recorder);
  const Dimensional plain = Dimensional::literal(9.81, -1, false),
                    metres = Dimensional::literal(2.0, -2, true);
  CHECK(*(plain * x).form() == form({{-1, 1}, {7, 1}}));
  CHECK(*(x / (plain * 2.0)).form() == form({{-1, -1}, {7, 1}}));
  CHECK((plain + plain).form() == nullptr);
  CHECK(recorder.take().empty());
  (void)(x + metres);
  CHECK(recorder.take() == std::vector<DimensionEquation>{{equal, form({{-2, 1}, {7, -1}})}});
}

TEST_CASE("an exponent that does not fit demands nothing") {
  DimensionRecorder recorder;
  Dimensional x(7, recorder);
  for (int k = 0; k < 20; ++k) x = pow(x, 100.0);
  CHECK(x.form() == nullptr);
  (void)(x + Dimensional(8, recorder));
  CHECK(recorder.take().empty());
}

TEST_CASE("a decimal and a rounded quotient stand for a fraction") {
  CHECK(nearest_fraction(0.3) == Rational::fraction(3, 10));
  CHECK(nearest_fraction(-2.0 / 7.0) == Rational::fraction(-2, 7));
  CHECK(nearest_fraction(12.0) == Rational(12));
  CHECK_FALSE(nearest_fraction(M_PI).has_value());
  CHECK_FALSE(nearest_fraction(1e300).has_value());
}

TEST_CASE("each equation of a block says which units agree") {
  CHECK(demands("Gain") == Demands{"gain u y^-1"});
  CHECK(demands("Sum", {{"signs", std::string("+-")}}) == Demands{"u1 u2^-1", "u1 y^-1"});
  CHECK(demands("Product", {{"signs", std::string("*/")}}) == Demands{"u1 u2^-1 y^-1"});
  CHECK(demands("Integrator") == Demands{"[s] u x^-1", "initial x^-1"});
  CHECK(demands("TrigonometricFunction") == Demands{"u", "y"});
  CHECK(demands("Clock") == Demands{"[s] y^-1"});
  CHECK(demands("Saturation") == Demands{"lower u^-1", "lower upper^-1", "upper y^-1", "upper u^-1"});
  CHECK(demands("Relay") == Demands{"on off^-1", "on y^-1", "switch_on u^-1", "switch_off u^-1"});
  CHECK(demands("Step") == Demands{"before after^-1", "after y^-1", "[s] time^-1"});
  CHECK(demands("UnitDelay", {{"sample_time", Rational(1)}}) ==
        Demands{"y last^-1", "u last^-1", "initial y^-1", "initial last^-1"});
}

TEST_CASE("a formula demands what its operators do") {
  // max(u, w) + gain*sin(u)^2
  CHECK(demands("Expression", {{"inputs", Words{"u", "w"}}, {"formula", example_formula()}}) ==
        Demands{"u", "u w^-1", "u gain^-1", "u y^-1"});
}

}  // namespace flyball::test
