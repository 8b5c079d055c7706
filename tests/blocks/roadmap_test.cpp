// Paths between obstacles: distances in closed form, and what every path must hold to.
#include <cmath>

#include "blocks/navigation/path.h"
#include "blocks/navigation/probabilistic_roadmap.h"
#include "tests/blocks/bench.h"
#include "tests/catch.h"

namespace flyball::test {
namespace {

/// Three discs of 90 mm between (200, 200) and (700, 1400) mm, for a robot of 40 mm.
const Keys scene{{"workspace", Table{{0.0, 0.0}, {0.9, 1.6}}},
                 {"discs", Table{{0.33, 0.62, 0.09}, {0.56, 0.9, 0.09}, {0.3, 1.12, 0.09}}},
                 {"start", Table{{0.2, 0.2}}},
                 {"goal", Table{{0.7, 1.4}}},
                 {"robot_radius", Table{{0.04}}}};

Keys with(Keys keys, const std::string& key, Value value) {
  keys.insert_or_assign(key, std::move(value));
  return keys;
}

Path path_of(const Keys& keys) {
  const BlockObject object = create("RoadmapPlanner", keys);
  return *std::static_pointer_cast<const Path>(object.specification->slots.back().make_object());
}

Words refusal_of(const Keys& keys) {
  TableSettings settings(keys);
  find_block_type("RoadmapPlanner")->create(&settings);
  return settings.refused();
}

double length(const Path& path) {
  double sum = 0.0;
  for (int k = 1; k <= path.last(); ++k)
    sum += std::hypot(path.x[k] - path.x[k - 1], path.y[k] - path.y[k - 1]);
  return sum;
}

/// From the discs of `scene`, at every millimetre of the path.
double clearance(const Path& path) {
  double nearest = infinity;
  for (int k = 1; k <= path.last(); ++k) {
    const double dx = path.x[k] - path.x[k - 1], dy = path.y[k] - path.y[k - 1];
    const int steps = std::max(1, static_cast<int>(std::hypot(dx, dy) / 1e-3));
    for (int i = 0; i <= steps; ++i) {
      for (const auto& disc : std::get<Table>(scene.at("discs"))) {
        const double x = path.x[k - 1] + dx * i / steps - disc[0],
                     y = path.y[k - 1] + dy * i / steps - disc[1];
        nearest = std::min(nearest, std::hypot(x, y) - disc[2]);
      }
    }
  }
  return nearest;
}

}  // namespace

TEST_CASE("A scene tells how far a point or a segment is from walls and obstacles") {
  Scene s;
  s.lower = {0.0, 0.0}, s.upper = {10.0, 8.0};
  CHECK(s.clearance({3.0, 2.5}) == 2.5);
  CHECK(s.clearance({9.0, 4.0}) == 1.0);
  CHECK(s.clearance({-1.0, 4.0}) == -1.0);
  CHECK(s.clearance({1.0, 3.0}, {7.0, 6.0}) == 1.0);
  s.discs = {{{5.0, 4.0}, 1.0}};
  CHECK(s.clearance({5.0, 6.0}) == 1.0);
  CHECK(s.clearance({3.0, 5.5}, {7.0, 5.5}) == 0.5);
  CHECK(s.clearance({5.0, 4.5}) == -0.5);
  s.discs.clear();
  s.polygons = {{{4.0, 3.0}, {6.0, 3.0}, {6.0, 5.0}, {4.0, 5.0}}};
  CHECK(s.clearance({3.0, 4.0}) == 1.0);
  CHECK(s.clearance({7.0, 6.0}) == std::sqrt(opaque(2.0)));
  CHECK(s.clearance({5.0, 4.0}) == 0.0);
  CHECK(s.clearance({3.0, 4.0}, {7.0, 4.5}) == 0.0);
  CHECK(s.clearance({3.0, 2.0}, {3.0, 6.0}) == 1.0);
}

TEST_CASE("RoadmapPlanner leads a robot around obstacles") {
  for (double seed = 0.0; seed < 6.0; ++seed) {
    INFO("seed " << seed);
    const Path path = path_of(with(scene, "seed", seed));
    REQUIRE(path.last() == 28);
    CHECK((path.x[0] == 0.2 && path.y[0] == 0.2 && path.x[28] == 0.7 && path.y[28] == 1.4));
    CHECK(clearance(path) >= 0.04 - 1e-12);  // a rounding of coordinates below 2
    // The straight line is 1.3 m long.
    CHECK(length(path) <= 1.3 * 1.3);
    for (int k = 1; k <= path.last(); ++k) {
      const double spacing = std::hypot(path.x[k] - path.x[k - 1], path.y[k] - path.y[k - 1]);
      CHECK(spacing > 0.027 / 2.0);
    }
    const Path again = path_of(with(scene, "seed", seed));
    CHECK((again.x == path.x && again.y == path.y));
  }
  CHECK(path_of(with(scene, "seed", 0.0)).x != path_of(with(scene, "seed", 1.0)).x);
}

TEST_CASE("RoadmapPlanner goes straight where nothing stands in the way, in even steps") {
  const Path path = path_of(with(with(scene, "discs", Table{}), "waypoints", 4.0));
  for (int k = 0; k <= 4; ++k) {
    CHECK(path.x[k] == Approx(0.2 + 0.125 * k).epsilon(1e-15));
    CHECK(path.y[k] == Approx(0.2 + 0.3 * k).epsilon(1e-15));
  }
}

TEST_CASE("RoadmapPlanner moves a waypoint to a corner that would be cut off") {
  // A wall from the left, with a gap at the right that the straight line misses.
  const Keys wall =
      with(with(scene, "discs", Table{}), "polygons", Table{{0.0, 0.8, 0.7, 0.8, 0.7, 0.85, 0.0, 0.85}});
  const Path path = path_of(with(wall, "waypoints", 5.0));
  REQUIRE(path.last() == 5);
  Scene s;
  s.upper = {0.9, 1.6};
  s.polygons = {{{0.0, 0.8}, {0.7, 0.8}, {0.7, 0.85}, {0.0, 0.85}}};
  for (int k = 1; k <= 5; ++k) {
    CHECK(s.clearance({path.x[k - 1], path.y[k - 1]}, {path.x[k], path.y[k]}) >= 0.04 - 1e-12);
  }
}

TEST_CASE("RoadmapPlanner says why there is no path") {
  CHECK(refusal_of(with(scene, "start", Table{{0.33, 0.6}})) ==
        Words{"start: the robot does not fit there: it needs 0.04 m around it, and has 0 m"});
  CHECK(refusal_of(with(scene, "goal", Table{{0.88, 1.4}})) ==
        Words{"goal: the robot does not fit there: it needs 0.04 m around it, and has 0.02 m"});
  const Keys closed = with(scene, "polygons", Table{{0.0, 0.8, 0.9, 0.8, 0.9, 0.85, 0.0, 0.85}});
  CHECK(refusal_of(with(closed, "samples", 50.0)) ==
        Words{": found no path from start to goal with 400 samples"});
  CHECK(
      refusal_of(with(
          with(with(scene, "discs", Table{}), "polygons", Table{{0.0, 0.8, 0.7, 0.8, 0.7, 0.85, 0.0, 0.85}}),
          "waypoints", 1.0)) == Words{"waypoints: too few waypoints for the corners of the path: 1"});
  CHECK(refusal_of(with(scene, "discs", Table{{0.3, 0.6}})) == Words{"discs: expected 3 lengths"});
  CHECK(refusal_of(with(scene, "polygons", Table{{0.3, 0.6, 0.4, 0.6}})) ==
        Words{"polygons: expected x and y of at least three corners, found 4 lengths"});
  CHECK(refusal_of(with(scene, "workspace", Table{{0.9, 1.6}, {0.0, 0.0}})) ==
        Words{"workspace: expected the lower left corner, then the upper right one"});
  CHECK(refusal_of(with(scene, "start", Table{{0.3}})) == Words{"start: expected 2 lengths"});
}

}  // namespace flyball::test
