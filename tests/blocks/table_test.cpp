// Lookup tables against the functions that they hold.
#include <cmath>

#include "tests/blocks/bench.h"
#include "tests/catch.h"

namespace flyball::test {
namespace {

using namespace std::string_literals;

const Numbers breakpoints{-1.0, 0.0, 0.5, 2.0};
const Numbers values{3.0, 0.0, -2.0, 4.0};

double at(Device& d, double u) {
  d["u"] = u;
  return d.update()["y"];
}

}  // namespace

TEST_CASE("LookupTable1D goes through its points on lines, and on beyond its ends") {
  Device d("LookupTable1D", {{"breakpoints", breakpoints}, {"table", values}});
  // In an order that jumps over intervals; dyadic numbers are exact.
  for (const auto& [u, y] : {std::pair{-0.5, 1.5},
                             {1.25, 1.0},
                             {-1.0, 3.0},
                             {2.0, 4.0},
                             {0.25, -1.0},
                             {0.0, 0.0},
                             {-3.0, 9.0},
                             {3.5, 10.0},
                             {0.5, -2.0}}) {
    INFO("u = " << u);
    CHECK(at(d, u) == y);
  }
}

TEST_CASE("LookupTable1D that clips stays at the values of its ends") {
  Device d("LookupTable1D", {{"breakpoints", breakpoints}, {"table", values}, {"extrapolation", "clip"s}});
  for (const auto& [u, y] :
       {std::pair{-3.0, 3.0}, {3.5, 4.0}, {-0.5, 1.5}, {-1.0, 3.0}, {1.25, 1.0}, {2.0, 4.0}, {0.5, -2.0}}) {
    INFO("u = " << u);
    CHECK(at(d, u) == y);
  }
}

TEST_CASE("LookupTable1D shows the value below, or the nearest one, of the upper of two that are as near") {
  Device below("LookupTable1D", {{"breakpoints", breakpoints}, {"table", values}, {"method", "flat"s}});
  Device nearest("LookupTable1D", {{"breakpoints", breakpoints}, {"table", values}, {"method", "nearest"s}});
  struct Row {
    double u, below, nearest;
  };
  for (const Row& row : {Row{-3.0, 3.0, 3.0}, Row{0.5, -2.0, -2.0}, Row{-0.6, 3.0, 3.0}, Row{-0.5, 3.0, 0.0},
                         Row{0.0, 0.0, 0.0}, Row{1.25, -2.0, 4.0}, Row{1.0, -2.0, -2.0}, Row{2.0, 4.0, 4.0},
                         Row{9.0, 4.0, 4.0}, Row{0.25, 0.0, -2.0}}) {
    INFO("u = " << row.u);
    CHECK(at(below, row.u) == row.below);
    CHECK(at(nearest, row.u) == row.nearest);
  }
}

TEST_CASE("LookupTable2D holds what is linear in each input exactly") {
  // f = 1 + 2 a - 3 b + 0.5 a b at the breakpoints; a table of it is f everywhere, beyond the ends too.
  const auto f = [](double a, double b) { return 1.0 + 2.0 * a - 3.0 * b + 0.5 * a * b; };
  const Numbers rows{-1.0, 1.0, 2.0}, columns{0.0, 0.5, 2.5, 4.0};
  Table table;
  for (const double a : rows) {
    Numbers& row = table.emplace_back();
    for (const double b : columns) row.push_back(f(a, b));
  }
  Device d("LookupTable2D", {{"breakpoints1", rows}, {"breakpoints2", columns}, {"table", table}});
  Device clipped(
      "LookupTable2D",
      {{"breakpoints1", rows}, {"breakpoints2", columns}, {"table", table}, {"extrapolation", "clip"s}});
  for (const double a : {-3.0, 0.3, 1.7, 5.0}) {
    for (const double b : {-1.0, 0.2, 1.1, 3.9, 7.0}) {
      d["u1"] = clipped["u1"] = a, d["u2"] = clipped["u2"] = b;
      d.update(), clipped.update();
      INFO("at " << a << ", " << b);
      // Ten roundings of numbers below 50.
      CHECK(std::fabs(d["y"] - f(a, b)) <= 10 * 50 * 0x1p-53);
      CHECK(std::fabs(clipped["y"] - f(std::clamp(a, -1.0, 2.0), std::clamp(b, 0.0, 4.0))) <=
            10 * 50 * 0x1p-53);
    }
  }
}

TEST_CASE("Tables whose sizes do not agree are refused") {
  CHECK_THROWS_WITH(
      create("LookupTable1D", {{"breakpoints", Numbers{0.0, 1.0}}, {"table", Numbers{1.0, 2.0, 3.0}}}),
      "table: expected 2 numbers, one for each breakpoint, found 3");
  CHECK_THROWS_WITH(create("LookupTable1D", {{"breakpoints", Numbers{0.0}}, {"table", Numbers{1.0}}}),
                    "breakpoints: expected at least two numbers");
  CHECK_THROWS_WITH(create("LookupTable1D", {{"method", "flat"s}, {"extrapolation", "linear"s}}),
                    "extrapolation: expected \"clip\": only the method \"linear\" goes on beyond the ends");
  CHECK_THROWS_WITH(create("LookupTable2D", {{"breakpoints1", Numbers{0.0, 1.0}}}),
                    "table: expected 2 by 3 numbers, found 3 by 3");
}

}  // namespace flyball::test
