#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "blocks/navigation/scene.h"

namespace flyball {

/// What a way through a scene is wanted for.
struct PathRequest {
  Point<double> start, goal;
  double radius = 0.0;  // of the robot, m
  int samples = 500;    // of the roadmap; doubled up to three times where there is no way
  int neighbours = 10;  // that each sample is joined to
  int waypoints = 28;   // behind the start
  std::uint64_t seed = 1;
};

/// Why there is no path.
enum class NoPath { start_blocked, goal_blocked, not_connected, too_few_waypoints };

/// A way that keeps the robot off walls and obstacles: the shortest one on a probabilistic roadmap (Kavraki,
/// Svestka, Latombe, Overmars 1996), without detours that a straight line can save, as the start and
/// `waypoints` points at equal distances along it. Where the straight line between two of them would meet
/// something, one of them moves to the corner of the way that it cut off. The same request gives the same
/// points.
std::variant<std::vector<Point<double>>, NoPath> plan_path(const Scene& scene, const PathRequest& request);

}  // namespace flyball
