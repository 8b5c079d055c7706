// What blocks refuse about their structure, and what they say.
#include "tests/blocks/bench.h"
#include "tests/blocks/formulas.h"
#include "tests/catch.h"

namespace flyball::test {
namespace {

using namespace std::string_literals;
using Refusals = std::vector<std::string>;

Refusals refusals(std::string_view type, Keys keys) {
  TableSettings settings(std::move(keys));
  const BlockObject object = find_block_type(type)->create(&settings);
  CHECK(object.specification->refused == !settings.refused().empty());
  return settings.refused();
}

}  // namespace

TEST_CASE("signs must be signs") {
  CHECK(refusals("Sum", {{"signs", "+*"s}}) ==
        Refusals{"signs: expected one + or - for each input, such as \"+-\", found \"+*\""});
  CHECK(refusals("Product", {{"signs", ""s}}) ==
        Refusals{"signs: expected one * or / for each input, such as \"*/\", found \"\""});
}

TEST_CASE("a choice names the choices") {
  CHECK(refusals("Integrator", {{"reset", "up"s}}) ==
        Refusals{"reset: expected \"none\", \"rising\", \"falling\", \"either\", found \"up\""});
  CHECK(refusals("Mux", {{"inputs", 0.0}}) ==
        Refusals{"inputs: expected a whole number from 1 to 1000, found 0"});
}

TEST_CASE("a sampled block needs a sample time above 0") {
  CHECK(refusals("UnitDelay", {{"initial", 0.0}}) ==
        Refusals{": a sampled block needs a sample_time, such as sample_time = \"10 ms\""});
  CHECK(refusals("UnitDelay", {{"sample_time", Rational(0)}}) ==
        Refusals{"sample_time: expected a time above 0 s, found 0 s"});
  CHECK(refusals("UnitDelay", {{"sample_time", Rational(1)}, {"offset", Rational(-1)}}) ==
        Refusals{"offset: expected a time of at least 0 s, found -1 s"});
}

TEST_CASE("TransferFcn refuses fractions that are not proper") {
  const Numbers second{1.0, 2.0, 5.0};
  CHECK(refusals("TransferFcn", {{"numerator", Numbers{1.0, 0.0, 0.0, 2.0}}, {"denominator", second}}) ==
        Refusals{"numerator: expected an order of at most 2, that of the denominator, found 3"});
  CHECK(refusals("TransferFcn", {{"denominator", Numbers{0.0, 1.0, 2.0}}}) ==
        Refusals{"denominator: expected a first coefficient that is not 0"});
  CHECK(refusals("TransferFcn", {{"denominator", Numbers{}}}) ==
        Refusals{"denominator: expected a first coefficient that is not 0"});
  CHECK(refusals("TransferFcn", {{"numerator", Numbers{0.0}}}) ==
        Refusals{"numerator: expected a coefficient that is not 0"});
  CHECK(refusals("TransferFcn", {{"numerator", Table{{1.0}, {2.0}}}}) ==
        Refusals{"numerator: expected a list of numbers, found a list of lists"});
}

TEST_CASE("StateSpace names the shape that it expected") {
  const Table A{{0.0, 1.0}, {-2.0, -3.0}};
  CHECK(refusals("StateSpace", {{"A", A}, {"B", Table{{1.0}}}, {"C", Table{{1.0, 0.0, 0.0}}}}) ==
        Refusals{"B: expected 2 by 1 numbers, found 1 by 1", "C: expected 1 by 2 numbers, found 1 by 3"});
  CHECK(refusals("StateSpace", {{"A", Table{{1.0, 2.0}}}}) ==
        Refusals{"A: expected 1 by 1 numbers, found 1 by 2"});
  CHECK(
      refusals("StateSpace", {{"A", A},
                              {"B", Table{{0.0}, {1.0}}},
                              {"C", Table{{1.0, 0.0}}},
                              {"D", Table{{1.0, 2.0}}},
                              {"initial", Numbers{1.0}}}) ==
      Refusals{"D: expected 1 by 1 numbers, found 1 by 2", "initial: expected 1 by 2 numbers, found 1 by 1"});
  CHECK(refusals("StateSpace", {{"A", Table{}}, {"B", Table{}}, {"C", Table{}}}).front() ==
        "A: expected at least one row");
}

TEST_CASE("the inputs of an Expression have names of their own") {
  CHECK(refusals("Expression", {{"inputs", Words{"u", "u", "w"}}, {"formula", example_formula()}}) ==
        Refusals{"inputs: the name \"u\" stands twice"});
  CHECK(refusals("Expression", {{"inputs", Words{"y", "u"}}, {"formula", example_formula()}}) ==
        Refusals{"inputs: the output is named y, so no input can be"});
  CHECK(refusals("Expression", {{"inputs", Words{}}}) ==
        Refusals{": expected a formula, since there are no inputs"});
}

TEST_CASE("coefficients are parameters, and a literal 0 is none") {
  const BlockObject object =
      create("TransferFcn", {{"numerator", Numbers{2.0, 0.0}}, {"denominator", Numbers{1.0, 0.0, 5.0}}});
  std::vector<std::string> names;
  for (const SlotSpec& slot : object.specification->slots) {
    if (slot.kind == SlotKind::param) names.push_back(slot.name);
  }
  CHECK(names == std::vector<std::string>{"numerator[0]", "denominator[0]", "denominator[2]"});
}

TEST_CASE("Selector picks elements that are there") {
  CHECK(refusals("Selector", {{"width", 3.0}, {"indices", Numbers{1.0, 4.0}}}) ==
        Refusals{"indices: expected whole numbers from 1 to 3, found 4"});
  CHECK(refusals("Selector", {{"indices", Numbers{}}}) ==
        Refusals{"indices: expected whole numbers from 1 to 2, found an empty list"});
}

TEST_CASE("Delay wants one initial value for each sample time of its length") {
  CHECK(refusals("Delay",
                 {{"sample_time", Rational(1)}, {"length", 3.0}, {"initial_values", Numbers{1.0, 2.0}}}) ==
        Refusals{"initial_values: expected 3 numbers, as many as `length`, found 2"});
}

TEST_CASE("ZeroPole refuses more zeros than poles, and pairs that are none") {
  CHECK(refusals("ZeroPole", {{"zeros", Numbers{1.0, 2.0}}, {"poles", Numbers{-1.0}}}) ==
        Refusals{"zeros: expected at most 1, the number of poles, found 2"});
  CHECK(refusals("ZeroPole", {{"complex_poles", Table{{-1.0, 2.0, 3.0}}}}) ==
        Refusals{"complex_poles: expected pairs [re, im]"});
}

TEST_CASE("RepeatingSequence wants as many values as times") {
  CHECK(refusals("RepeatingSequence", {{"times", Numbers{0.0, 1.0}}, {"values", Numbers{1.0, 2.0, 3.0}}}) ==
        Refusals{"values: expected 2 values, one for each time, found 3"});
  CHECK(refusals("RepeatingSequence", {{"times", Numbers{1.0}}, {"values", Numbers{1.0}}}) ==
        Refusals{"times: expected at least two times"});
}

TEST_CASE("FromFile needs a file") {
  CHECK(refusals("FromFile", {{"before", "zero"s}}) ==
        Refusals{": expected a file, such as file = \"step.csv\""});
}

}  // namespace flyball::test
