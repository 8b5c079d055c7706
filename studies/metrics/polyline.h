#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace flyball {

struct Point {
  double x = 0.0, y = 0.0;
};

/// A path of straight legs.
struct Polyline {
  std::vector<Point> points;  // at least two
  std::string unit = "any";

  /// The leg that ends in the point whose number is nearest to `index`, the first point being 0: ends of it.
  std::pair<Point, Point> leg(double index) const;
};

/// From a point to the nearest one of a leg, of the line through it, and of the path.
double segment_distance(Point p, const std::pair<Point, Point>& leg);
double line_distance(Point p, const std::pair<Point, Point>& leg);
double distance(Point p, const Polyline& path);

/// Reads the columns x and y. Throws std::runtime_error with all that is wrong.
Polyline read_polyline(const std::filesystem::path& file);

}  // namespace flyball
