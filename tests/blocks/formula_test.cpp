#include "blocks/formula.h"

#include "blocks/jet.h"
#include "tests/blocks/bench.h"
#include "tests/blocks/formulas.h"
#include "tests/catch.h"

namespace flyball::test {
namespace {

using Op = Formula::Op;

double value(const Formula& formula, const std::vector<double>& operands) {
  return formula.evaluate<double>([&](int i) { return operands[i]; },
                                  [](int, double a, double b) { return a > b; });
}

double of_one(Op op, double x) {
  FormulaBuilder f;
  f.apply(op, f.name("x"));
  return value(*f.finish("f(x)"), {x});
}

double of_two(Op op, double a, double b) {
  FormulaBuilder f;
  const int first = f.name("a"), second = f.name("b");
  f.apply(op, first, second);
  return value(*f.finish("f(a, b)"), {a, b});
}

}  // namespace

// A formula calls the function that it names, so that the results are the same bits.
TEST_CASE("a formula computes each operation") {
  const double x = opaque(0.7), y = opaque(-0.3);
  CHECK(of_two(Op::add, x, y) == x + y);
  CHECK(of_two(Op::subtract, x, y) == x - y);
  CHECK(of_two(Op::multiply, x, y) == x * y);
  CHECK(of_two(Op::divide, x, y) == x / y);
  CHECK(of_two(Op::power, x, y) == std::pow(x, y));
  CHECK(of_two(Op::atan2, x, y) == std::atan2(x, y));
  CHECK(of_two(Op::hypot, x, y) == std::hypot(x, y));
  CHECK(of_one(Op::negate, x) == -x);
  CHECK(of_one(Op::sin, x) == std::sin(x));
  CHECK(of_one(Op::cos, x) == std::cos(x));
  CHECK(of_one(Op::tan, x) == std::tan(x));
  CHECK(of_one(Op::asin, x) == std::asin(x));
  CHECK(of_one(Op::acos, x) == std::acos(x));
  CHECK(of_one(Op::atan, x) == std::atan(x));
  CHECK(of_one(Op::sinh, x) == std::sinh(x));
  CHECK(of_one(Op::cosh, x) == std::cosh(x));
  CHECK(of_one(Op::tanh, x) == std::tanh(x));
  CHECK(of_one(Op::exp, x) == std::exp(x));
  CHECK(of_one(Op::log, x) == std::log(x));
  CHECK(of_one(Op::log10, x) == std::log10(x));
  CHECK(of_one(Op::sqrt, x) == std::sqrt(x));
}

TEST_CASE("conditions choose between values") {
  const auto f = branching_formula();
  CHECK(f->comparisons == 4);
  CHECK(value(*f, {0.5, 0.25}) == 0.125);  // u > w and not w > 1
  CHECK(value(*f, {1.75, 1.5}) == -1.75);  // u > w > 1
  CHECK(value(*f, {2.5, 3.0}) == 7.5);     // u > 2
  CHECK(value(*f, {0.25, 0.5}) == 0.25);   // w/2
}

TEST_CASE("a power with a literal exponent takes a negative base, with its derivative") {
  FormulaBuilder f;
  const int base = f.name("x");
  f.apply(Op::power, base, f.literal(3.0));
  const auto cube = f.finish("x^3");
  const Jet result = cube->evaluate<Jet>([](int) { return Jet(-2.0, 0); },
                                         [](int, const Jet& a, const Jet& b) { return a.a > b.a; });
  CHECK(result.a == -8.0);
  CHECK(result.v[0] == 12.0);
}

TEST_CASE("an expression computes its formula with one relation a comparison") {
  Device d("Expression", {{"inputs", Words{"u", "w"}}, {"formula", example_formula()}});
  d["gain"] = 3.0;
  d["u"] = 0.5, d["w"] = -1.0;
  d.update();
  CHECK(d["comparison1"] == 1.5);
  CHECK(d["y"] == 0.5 + 3.0 * std::pow(std::sin(opaque(0.5)), 2.0));
  d["w"] = 2.0;
  d.update();
  CHECK(d["comparison1"] == -1.5);
  CHECK(d["y"] == 2.0 + 3.0 * std::pow(std::sin(opaque(0.5)), 2.0));
}

TEST_CASE("a bit of an expression decides until it changes, whatever the values are") {
  Device d("Expression", {{"inputs", Words{"u", "w"}}, {"formula", example_formula()}});
  d["u"] = 1.0, d["w"] = 0.0;
  d.update();
  d["w"] = 5.0;
  d.bench().run(Phase::outputs);
  CHECK(d["y"] == 1.0);
}

TEST_CASE("the free names of a formula are parameters of the model") {
  const BlockObject object = create("Expression", {{"inputs", Words{"w"}}, {"formula", example_formula()}});
  std::vector<std::string> references;
  for (const SlotSpec& slot : object.specification->slots) {
    if (!slot.reference.empty()) references.push_back(slot.reference);
  }
  CHECK(references == std::vector<std::string>{"u", "gain"});
}

}  // namespace flyball::test
