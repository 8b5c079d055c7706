// Blocks whose output is a truth value, 0 or 1.
#include <cmath>
#include <limits>

#include "tests/blocks/bench.h"
#include "tests/catch.h"

namespace flyball::test {
namespace {

using namespace std::string_literals;

struct Function {
  std::string name;
  bool (*of)(int on, int n);  // of the number of inputs that are true
};

const std::vector<Function> functions{
    {"AND", [](int on, int n) { return on == n; }},   {"NAND", [](int on, int n) { return on < n; }},
    {"OR", [](int on, int) { return on > 0; }},       {"NOR", [](int on, int) { return on == 0; }},
    {"XOR", [](int on, int) { return on % 2 == 1; }}, {"NXOR", [](int on, int) { return on % 2 == 0; }}};

struct Comparison {
  std::string name;
  bool (*of)(double a, double b);
};

const std::vector<Comparison> comparisons{
    {"==", [](double a, double b) { return a == b; }}, {"~=", [](double a, double b) { return a != b; }},
    {"<", [](double a, double b) { return a < b; }},   {"<=", [](double a, double b) { return a <= b; }},
    {">=", [](double a, double b) { return a >= b; }}, {">", [](double a, double b) { return a > b; }}};

}  // namespace

TEST_CASE("LogicalOperator has the truth tables of its functions, for any number of inputs") {
  for (const Function& f : functions) {
    for (const int n : {1, 2, 3, 5}) {
      Device d("LogicalOperator", {{"operator", f.name}, {"inputs", double(n)}});
      for (int row = 0; row < 1 << n; ++row) {
        for (int k = 0; k < n; ++k) d["u" + std::to_string(k + 1)] = row >> k & 1;
        d.update();
        INFO(f.name << " of " << n << ", row " << row);
        CHECK(d["y"] == f.of(__builtin_popcount(row), n));
      }
    }
  }
}

TEST_CASE("LogicalOperator takes all that is not zero for true, at once and back") {
  Device d("LogicalOperator", {{"operator", "NOT"s}});
  for (const double u : {0.0, -3.0, 0.0, 1e-300, -0.0, std::numeric_limits<double>::infinity()}) {
    d["u1"] = u;
    d.update();
    INFO("u = " << u);
    CHECK(d["y"] == (u == 0.0));
  }
}

TEST_CASE("LogicalOperator with NOT refuses a second input") {
  CHECK_THROWS_WITH(create("LogicalOperator", {{"operator", "NOT"s}, {"inputs", 2.0}}),
                    "inputs: expected 1 for NOT, found 2");
}

TEST_CASE("RelationalOperator compares, and knows equal numbers from whatever it comes") {
  const double next = std::nextafter(1.0, 2.0);
  for (const Comparison& c : comparisons) {
    Device d("RelationalOperator", {{"operator", c.name}});
    for (const auto& [a, b] : {std::pair{1.0, 1.0},
                               {1.0, 2.0},
                               {2.0, 2.0},
                               {3.0, 2.0},
                               {3.0, 3.0},
                               {next, 1.0},
                               {1.0, 1.0},
                               {1.0, next},
                               {0.0, -0.0},
                               {0.0, 1e-300}}) {
      d["u1"] = a, d["u2"] = b;
      d.update();
      INFO(a << ' ' << c.name << ' ' << b);
      CHECK(d["y"] == c.of(a, b));
    }
  }
}

}  // namespace flyball::test
