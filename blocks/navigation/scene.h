#pragma once

#include <vector>

#include "blocks/se2.h"

namespace flyball {

/// What a robot drives in: a rectangle with obstacles. Lengths in m.
struct Scene {
  struct Disc {
    Point<double> centre;
    double radius;
  };
  using Polygon = std::vector<Point<double>>;  // its last corner is joined to the first

  Point<double> lower{0.0, 0.0}, upper{1.0, 1.0};
  std::vector<Disc> discs;
  std::vector<Polygon> polygons;

  /// How far a point is from the nearest wall or obstacle; not above 0 inside of one, or outside of all.
  double clearance(const Point<double>& p) const { return clearance(p, p); }
  /// The same of all points of the segment from a to b.
  double clearance(const Point<double>& a, const Point<double>& b) const;
};

}  // namespace flyball
