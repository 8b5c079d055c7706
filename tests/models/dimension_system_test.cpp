// Exact elimination, against a dense one that is written for clarity.
#include "models/dimension_system.h"

#include <random>

#include "tests/catch.h"

namespace flyball {
namespace {

constexpr int x = base_units, y = base_units + 1, z = base_units + 2;

LinearForm form(const std::vector<std::pair<int, Rational>>& terms) {
  LinearForm result;
  for (const auto& [unknown, coefficient] : terms) REQUIRE(result.add(LinearForm(unknown), coefficient));
  return result;
}

DimensionSystem system_of(const std::vector<LinearForm>& equations, int unknowns) {
  std::vector<const LinearForm*> pointers;
  for (const LinearForm& equation : equations) pointers.push_back(&equation);
  return {unknowns, pointers};
}

/// Rows over the unknowns and the base units, eliminated in order; gives the rows that contradict those
/// before.
std::vector<int> contradictions_of_dense(const std::vector<LinearForm>& equations, int unknowns) {
  std::vector<std::vector<Rational>> rows;
  std::vector<int> pivots, result;
  for (int number = 0; number < static_cast<int>(equations.size()); ++number) {
    std::vector<Rational> row(unknowns);
    for (const auto& [unknown, coefficient] : equations[number].terms()) row[unknown] = coefficient;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const Rational factor = row[pivots[k]];
      for (int u = 0; u < unknowns; ++u) row[u] = *subtract(row[u], *multiply(factor, rows[k][u]));
    }
    int pivot = unknowns - 1;
    while (pivot >= 0 && row[pivot].numerator() == 0) --pivot;
    if (pivot < 0) continue;
    if (pivot < base_units) {
      result.push_back(number);
      continue;
    }
    const Rational leading = row[pivot];
    for (Rational& entry : row) entry = *divide(entry, leading);
    rows.push_back(row);
    pivots.push_back(pivot);
  }
  return result;
}

/// Sparse, as in a diagram: two or three unknowns with exponents of -2 to 2, one base unit.
std::vector<LinearForm> random_equations(std::mt19937& random, int unknowns, int count) {
  const auto pick = [&](int first, int last) {
    return first + static_cast<int>(random() % static_cast<unsigned>(last - first + 1));
  };
  std::vector<LinearForm> equations(count);
  for (LinearForm& equation : equations) {
    for (int k = pick(1, 3); k > 0; --k) {
      REQUIRE(equation.add(LinearForm(pick(base_units, unknowns - 1)), Rational(pick(-2, 2))));
    }
    if (pick(0, 2) == 0) REQUIRE(equation.add(LinearForm(pick(0, 2)), Rational(pick(-1, 1))));
  }
  return equations;
}

}  // namespace

TEST_CASE("sparse and dense elimination find the same contradictions") {
  std::mt19937 random(1);
  int contradictory = 0;
  for (int k = 0; k < 500; ++k) {
    const int unknowns = base_units + 12;
    const auto equations = random_equations(random, unknowns, 4 + k % 14);
    const auto expected = contradictions_of_dense(equations, unknowns);
    contradictory += expected.empty() ? 0 : 1;
    CHECK(system_of(equations, unknowns).contradictions() == expected);
  }
  CHECK(contradictory > 100);
  CHECK(contradictory < 400);
}

TEST_CASE("what the equations determine comes down to base units") {
  // x = y s, y = m/z^2, z = kg^(1/2)
  auto system = system_of({form({{x, 1}, {y, -1}, {2, -1}}), form({{y, 1}, {0, -1}, {z, 2}}),
                           form({{z, 1}, {1, *Rational::fraction(-1, 2)}})},
                          z + 1);
  CHECK(system.contradictions().empty());
  CHECK(system.reduced(LinearForm(x)) == form({{0, 1}, {1, -1}, {2, 1}}));
  CHECK(system.reduced(form({{x, 1}, {y, -1}})) == form({{2, 1}}));
}

TEST_CASE("what the equations do not determine keeps an unknown, unless it cancels") {
  auto system = system_of({form({{x, 1}, {z, -1}, {0, -1}}), form({{y, 1}, {z, -1}})}, z + 1);
  const auto alone = system.reduced(LinearForm(x));
  REQUIRE(alone.has_value());
  CHECK(alone->terms().back().unknown >= base_units);
  CHECK(system.reduced(form({{x, 1}, {y, -1}})) == form({{0, 1}}));
}

TEST_CASE("an equation that contradicts those before it is left out") {
  auto system = system_of({form({{x, 1}, {0, -1}}), form({{x, 1}, {y, -1}}), form({{y, 1}, {2, -1}})}, y + 1);
  CHECK(system.contradictions() == std::vector<int>{2});
  CHECK(system.reduced(LinearForm(y)) == form({{0, 1}}));
}

TEST_CASE("exponents that do not fit are left out, not wrapped") {
  // u_(k+1) = 1000 u_k, used twice each so that none is solved for by itself, down to u_0 = m and u_9 = s.
  std::vector<LinearForm> equations{form({{x, 1}, {0, -1}})};
  for (int k = 0; k < 9; ++k) equations.push_back(form({{x + k + 1, 1}, {x + k, -1000}}));
  equations.push_back(form({{x + 9, 1}, {2, -1}}));
  auto system = system_of(equations, x + 10);
  CHECK(system.contradictions().empty());
  CHECK(system.reduced(LinearForm(x + 6)) == form({{0, 1'000'000'000'000'000'000}}));
  CHECK_FALSE(system.reduced(form({{x + 6, 1000}})).has_value());
}

TEST_CASE("a chain of a hundred thousand equations is solved from either end") {
  constexpr int n = 100'000;
  for (const bool backwards : {false, true}) {
    std::vector<LinearForm> equations;
    for (int k = 0; k < n; ++k) {
      const int at = backwards ? n - 1 - k : k;
      equations.push_back(form({{x + at + 1, 1}, {x + at, -1}}));
    }
    equations.push_back(form({{x + n, 1}, {0, -1}}));
    auto system = system_of(equations, x + n + 1);
    CHECK(system.reduced(LinearForm(x)) == form({{0, 1}}));
  }
}

}  // namespace flyball
