#include "solvers/root.h"

#include <cmath>
#include <functional>
#include <string>

#include "tests/catch.h"

using namespace flyball;

namespace {

/// z on [start, start + length] as a function of the fraction u; positive first, and negative from `root` on.
struct RootCase {
  std::string name;
  std::function<double(double)> z;
  double root;
  int most_evaluations;
};

// What is smooth over a step needs seven evaluations; 160 are three for each bit of a double and a few.
const RootCase cases[] = {
    {"line", [](double u) { return 0.37 - u; }, 0.37, 5},
    {"cosine", [](double u) { return std::cos(1.2 * u + 0.9); }, (M_PI / 2 - 0.9) / 1.2, 8},
    {"parabola", [](double u) { return 0.3 - u * u; }, std::sqrt(0.3), 11},
    {"exponential", [](double u) { return 1.0 - std::exp(5.0 * (u - 0.8)); }, 0.8, 12},
    {"root near the start", [](double u) { return 0.01 - u + 0.3 * u * u; }, (1.0 - std::sqrt(0.988)) / 0.6,
     8},
    {"root near the end", [](double u) { return 0.999 - u; }, 0.999, 5},
    {"steep", [](double u) { return -std::tanh(1e4 * (u - 0.613)); }, 0.613, 30},
    {"flat", [](double u) { return -std::pow(u - 0.4, 9); }, 0.4, 160},
    {"jump", [](double u) { return u < 0.31 ? 1.0 : -1.0; }, 0.31, 160},
    {"jump from afar", [](double u) { return u < 0.31 ? 1e-12 : -1e12; }, 0.31, 160},
    {"zero for a while", [](double u) { return u < 0.4 ? 0.0 : 0.4 - u; }, 0.4, 160},
    {"leaves and returns", [](double u) { return u * (0.62 - u); }, 0.62, 12},
    {"starts beyond by rounding", [](double u) { return u * (0.2 - u) - 1e-17; }, 0.2, 14},
};

}  // namespace

TEST_CASE("Roots are located to the last places, on the far side") {
  for (const RootCase& c : cases) {
    for (const double start : {0.0, 10.0}) {
      for (const double length : {1e-3, 1.0}) {
        for (const int side : {1, -1}) {
          INFO(c.name << " from " << start << " over " << length << ", side " << side);
          int evaluations = 0;
          const auto z = [&](double t) {
            ++evaluations;
            return side * c.z((t - start) / length);
          };
          const double found = locate_root(start, start + length, side, z);
          CHECK(side * z(found) < 0.0);
          // The bracket closes to 4 eps; the fraction u and c.root have a rounding of their own, about as
          // large.
          const double rounding = 8.0 * 2.2e-16 * (start + length);
          // (u - 0.4)^9 underflows no sooner than 1e-34 from its root: flatness costs no accuracy.
          CHECK(std::fabs(found - (start + length * c.root)) <= rounding);
          CHECK(evaluations <= c.most_evaluations + 1);  // and the one of this test
        }
      }
    }
  }
}

TEST_CASE("A change at the very start is found there") {
  // Beyond zero at every point after the start, which is itself at zero or at rounding level.
  for (const double at_start : {0.0, -1e-18}) {
    const double start = 3.0;
    const double found =
        locate_root(start, 4.0, 1, [&](double t) { return t > start ? start - t : at_start; });
    CHECK(found > start);
    CHECK(found - start <= 8.0 * 2.2e-16 * 4.0);
  }
}

TEST_CASE("A change that rounding takes back is at the end") {
  int evaluations = 0;
  const double found = locate_root(0.0, 1.0, 1, [&](double t) {
    ++evaluations;
    return 1.0 - t;
  });
  CHECK(found == 1.0);
  CHECK(evaluations == 2);
}

TEST_CASE("The first of the changes that halving separates is found") {
  // Positive on (0, 0.1), negative until 0.3, positive until 0.9; the start is at zero, so the search begins
  // by halving.
  const auto z = [](double t) { return t * (0.1 - t) * (0.3 - t) * (0.9 - t); };
  const double found = locate_root(0.0, 0.25, 1, z);
  CHECK(found == Approx(0.1).epsilon(1e-14));
}

namespace {

/// A quartic on [0, 1] that is positive before `root`, and its derivative.
struct SmoothCase {
  std::string name;
  double c[5];
  double root;
  int most_evaluations;

  double z(double u) const { return c[0] + u * (c[1] + u * (c[2] + u * (c[3] + u * c[4]))); }
  double slope(double u) const { return c[1] + u * (2.0 * c[2] + u * (3.0 * c[3] + u * 4.0 * c[4])); }
};

// A parabola takes its formula and a confirmation, another smooth curve three or four steps more; a triple
// root leaves Newton a third of the way each time, and the rest to bisection.
const SmoothCase smooth_cases[] = {
    {"line", {0.37, -1.0, 0.0, 0.0, 0.0}, 0.37, 12},
    {"flight from the ground", {0.0, 1.0, -4.0, 0.0, 0.0}, 0.25, 12},
    {"flight from below the ground", {-1e-17, 1.0, -4.0, 0.0, 0.0}, 0.25, 12},
    {"cubic", {0.512, 0.0, 0.0, -1.0, 0.0}, 0.8, 22},
    {"quartic", {0.0625, 0.0, 0.0, 0.0, -1.0}, 0.5, 22},
    {"falls at once", {0.0, -1.0, 0.0, 0.0, 0.0}, 0.0, 160},
    {"triple root", {0.064, -0.48, 1.2, -1.0, 0.0}, 0.4, 160},
};

}  // namespace

TEST_CASE("With a derivative, roots of smooth curves are located as sharply") {
  for (const SmoothCase& c : smooth_cases) {
    for (const double start : {0.0, 10.0}) {
      for (const int side : {1, -1}) {
        INFO(c.name << " from " << start << ", side " << side);
        int evaluations = 0;
        const auto z = [&](double t) {
          ++evaluations;
          return side * c.z(t - start);
        };
        const double found =
            locate_root(start, start + 1.0, side, z, [&](double t) { return side * c.slope(t - start); });
        CHECK(side * z(found) < 0.0);
        // The bracket closes to 4 eps where z is clean; its terms, of size 4, leave the sum a rounding of
        // 1e-15, which a slope of at least 0.5 turns into 2e-15, and a triple root into its cube root.
        const double blurred = c.name == "triple root" ? std::cbrt(1e-15) : 2e-15;
        CHECK(std::fabs(found - (start + c.root)) <= 8.0 * 2.2e-16 * (start + 1.0) + blurred);
        CHECK(evaluations <= c.most_evaluations + 1);  // and the one of this test
      }
    }
  }
}

TEST_CASE("With a derivative, a change that rounding takes back is at the end") {
  const double found = locate_root(
      0.0, 1.0, 1, [](double t) { return 1.0 - t; }, [](double) { return -1.0; });
  CHECK(found == 1.0);
}
