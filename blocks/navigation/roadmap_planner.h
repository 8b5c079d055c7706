#pragma once
#include <fmt/format.h>

#include "blocks/block.h"
#include "blocks/navigation/path.h"
#include "blocks/navigation/probabilistic_roadmap.h"

namespace flyball {

struct RoadmapPlanner : Block {
  static constexpr auto summary = "A path for a robot between obstacles, found on a probabilistic roadmap.";
  NumberRows workspace = lengths("workspace", {{0.0, 0.0}, {1.0, 1.0}},
                                 "opposite corners of the rectangle that the robot stays in");
  NumberRows discs = lengths("discs", {}, "x and y of the centre, and the radius, of each round obstacle");
  NumberRows polygons =
      lengths("polygons", {}, "x and y of one corner after the other, of each obstacle with straight sides");
  NumberRows start = lengths("start", {{0.1, 0.1}}, "x and y of where the path begins");
  NumberRows goal = lengths("goal", {{0.9, 0.9}}, "x and y of where it ends");
  NumberRows radius =
      lengths("robot_radius", {{0.05}}, "how far the robot must keep off walls and obstacles");
  int samples = count("samples", 500, 2, 100000,
                      "places on the roadmap; up to eight times as many where these do not suffice");
  int neighbours = count("neighbours", 10, 1, 1000, "nearest places that each one is joined to");
  int waypoints = count("waypoints", 28, 1, 10000, "points of the path behind its start");
  int seed = count("seed", 1, 0, 2147483647, "of the places: another one gives another path");
  ObjectOutput<Path> path = object_output<Path>("path", planned(), "the points");

 private:
  std::shared_ptr<const Path> planned() {
    if (!well_formed()) return std::make_shared<const Path>();
    const PathRequest request = {{start[0][0], start[0][1]},
                                 {goal[0][0], goal[0][1]},
                                 radius[0][0],
                                 samples,
                                 neighbours,
                                 waypoints,
                                 static_cast<std::uint64_t>(seed)};
    const Scene of = scene();
    const auto found = plan_path(of, request);
    if (const auto* points = std::get_if<0>(&found)) {
      NumberRows rows;
      for (const Point<double>& point : *points) rows.push_back({point.x, point.y});
      return std::make_shared<const Path>(rows);
    }
    switch (std::get<NoPath>(found)) {
      case NoPath::start_blocked:
        refuse_place("start", of, request.start);
        break;
      case NoPath::goal_blocked:
        refuse_place("goal", of, request.goal);
        break;
      case NoPath::not_connected:
        refuse("", fmt::format("found no path from start to goal with {} samples", 8 * samples));
        break;
      case NoPath::too_few_waypoints:
        refuse(given("waypoints") ? "waypoints" : "",
               fmt::format("too few waypoints for the corners of the path: {}", waypoints));
    }
    return std::make_shared<const Path>();
  }

  bool well_formed() {
    bool fine = expect_rows("workspace", workspace, 2, 2) && expect_rows("start", start, 1, 2);
    fine = expect_rows("goal", goal, 1, 2) && expect_rows("robot_radius", radius, 1, 1) && fine;
    fine = expect_rows("discs", discs, static_cast<int>(discs.size()), 3) && fine;
    for (const auto& polygon : polygons) {
      if (polygon.size() >= 6 && polygon.size() % 2 == 0) continue;
      refuse("polygons",
             fmt::format("expected x and y of at least three corners, found {} lengths", polygon.size()));
      return false;
    }
    if (!fine || (workspace[0][0] < workspace[1][0] && workspace[0][1] < workspace[1][1])) return fine;
    refuse("workspace", "expected the lower left corner, then the upper right one");
    return false;
  }

  bool expect_rows(const std::string& key, const NumberRows& rows, int count, int width) {
    bool fits = static_cast<int>(rows.size()) == count;
    for (const auto& row : rows) fits = fits && static_cast<int>(row.size()) == width;
    if (fits) return true;
    refuse(key, count > 1 ? fmt::format("expected rows of {} lengths, {} of them", width, count)
                          : fmt::format("expected {} length{}", width, width > 1 ? "s" : ""));
    return false;
  }

  void refuse_place(const std::string& key, const Scene& of, const Point<double>& place) {
    refuse(key, fmt::format("the robot does not fit there: it needs {:.6g} m around it, and has {:.6g} m",
                            radius[0][0], std::max(of.clearance(place), 0.0)));
  }

  Scene scene() const {
    Scene result;
    result.lower = {workspace[0][0], workspace[0][1]};
    result.upper = {workspace[1][0], workspace[1][1]};
    for (const auto& disc : discs) result.discs.push_back({{disc[0], disc[1]}, disc[2]});
    for (const auto& row : polygons) {
      Scene::Polygon& polygon = result.polygons.emplace_back();
      for (std::size_t k = 0; k < row.size(); k += 2) polygon.push_back({row[k], row[k + 1]});
    }
    return result;
  }
};

}  // namespace flyball
