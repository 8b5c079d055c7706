#include "studies/pareto/front.h"

#include <cmath>
#include <random>

#include "tests/catch.h"

using namespace flyball;

namespace {

ParetoPoint point(double a, double b) { return {{a + b}, {a, b}}; }

/// Points of the line a + b = 1, unevenly where `power` is not 1.
std::vector<ParetoPoint> line(int count, double power = 1.0) {
  std::vector<ParetoPoint> points;
  for (int k = 0; k < count; ++k) {
    const double a = std::pow(static_cast<double>(k) / (count - 1), power);
    points.push_back(point(a, 1.0 - a));
  }
  return points;
}

ParetoArchive archive_of(const std::vector<ParetoPoint>& points) {
  ParetoArchive archive;
  for (const ParetoPoint& p : points) archive.show(p);
  return archive;
}

}  // namespace

TEST_CASE("A point dominates where it is nowhere worse and somewhere better") {
  CHECK(dominates({1, 2}, {1, 3}));
  CHECK(dominates({0, 2}, {1, 3}));
  CHECK_FALSE(dominates({1, 2}, {1, 2}));
  CHECK_FALSE(dominates({0, 4}, {1, 3}));
}

TEST_CASE("An archive is what an exhaustive comparison of all points leaves") {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> coordinate(0, 30);  // with many equals
  std::vector<ParetoPoint> shown;
  for (int k = 0; k < 400; ++k)
    shown.push_back({{0.0 + k}, {0.1 * coordinate(random), 0.1 * coordinate(random)}});
  std::vector<std::vector<double>> expected;
  for (const ParetoPoint& p : shown) {
    bool beaten = false;
    for (const ParetoPoint& q : shown) beaten |= dominates(q.objectives, p.objectives);
    if (!beaten) expected.push_back(p.objectives);
  }
  std::ranges::sort(expected);
  const auto doubles = std::ranges::unique(expected);
  expected.erase(doubles.begin(), doubles.end());
  std::vector<std::vector<double>> found;
  const ParetoArchive archive = archive_of(shown);
  for (const ParetoPoint& p : archive.points()) found.push_back(p.objectives);
  CHECK(found == expected);
}

TEST_CASE("Of points with equal objectives an archive keeps the first") {
  ParetoArchive archive;
  archive.show({{1.0}, {2.0, 3.0}});
  archive.show({{9.0}, {2.0, 3.0}});
  REQUIRE(archive.points().size() == 1);
  CHECK(archive.points()[0].parameters == std::vector{1.0});
}

TEST_CASE("Thinning leaves out crowded points and keeps the ends") {
  std::vector<ParetoPoint> points = line(5);
  points.push_back(point(0.51, 0.49));
  const std::vector<ParetoPoint> kept = archive_of(points).thinned(5);
  REQUIRE(kept.size() == 5);
  CHECK(kept.front().objectives == std::vector{0.0, 1.0});
  CHECK(kept.back().objectives == std::vector{1.0, 0.0});
  // One of the two close neighbours 0.5 and 0.51 went.
  CHECK(kept[2].objectives[0] > 0.49);
  CHECK(kept[2].objectives[0] < 0.52);
  CHECK(archive_of(points).thinned(1).size() == 2);
}

TEST_CASE("Spread is 0 on even points, and Delta by hand on others") {
  CHECK(spread(line(11)) == Approx(0.0).margin(1e-12));  // rounding of equal gaps
  // Gaps of 1/4 and 3/4 of sqrt 2: mean 1/2, both off by 1/4, so Delta = 1/2.
  CHECK(spread({point(0.0, 1.0), point(0.25, 0.75), point(1.0, 0.0)}) == Approx(0.5).epsilon(1e-12));
  CHECK(std::isnan(spread(line(2))));
  // Units do not count: the second objective in thousandths.
  std::vector<ParetoPoint> scaled = line(9, 2.0);
  const double unscaled = spread(scaled);
  for (ParetoPoint& p : scaled) p.objectives[1] *= 1000.0;
  CHECK(spread(scaled) == Approx(unscaled).epsilon(1e-12));
}

TEST_CASE("A point of a front is picked at its knee, by an objective, or by weights") {
  ParetoResult front;
  front.objectives = {"error", "effort"};
  front.minimised = 2;
  front.front = {point(0.0, 1.0), point(0.1, 0.3), point(0.4, 0.2), point(1.0, 0.0)};
  CHECK(pick_point(front, "knee", {}) == 1);
  CHECK(pick_point(front, "error", {}) == 0);
  CHECK(pick_point(front, "effort", {}) == 3);
  CHECK(pick_point(front, "weights", {1.0, 20.0}) == 3);
  front.minimised = 1;  // the effort is now wanted high, so the best of it comes first
  CHECK(pick_point(front, "effort", {}) == 0);
  front.front.clear();
  CHECK(pick_point(front, "knee", {}) == -1);
}
