#include "blocks/navigation/scene.h"

#include <algorithm>
#include <cmath>

#include "blocks/specification.h"

namespace flyball {
namespace {

using Corner = Point<double>;

/// Twice the area of a triangle, positive when c is to the left of the line from a to b.
double area(const Corner& a, const Corner& b, const Corner& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool cross(const Corner& a, const Corner& b, const Corner& c, const Corner& d) {
  return area(a, b, c) * area(a, b, d) < 0.0 && area(c, d, a) * area(c, d, b) < 0.0;
}

double between_segments(const Corner& a, const Corner& b, const Corner& c, const Corner& d) {
  if (cross(a, b, c, d)) return 0.0;
  return std::min({distance_from_segment(a, c, d), distance_from_segment(b, c, d),
                   distance_from_segment(c, a, b), distance_from_segment(d, a, b)});
}

/// A ray to the right crosses the edges of what surrounds its origin an odd number of times.
bool inside(const Scene::Polygon& polygon, const Corner& p) {
  bool odd = false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Corner &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    if ((a.y > p.y) == (b.y > p.y)) continue;
    if (p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) odd = !odd;
  }
  return odd;
}

double from_polygon(const Scene::Polygon& polygon, const Corner& a, const Corner& b) {
  if (inside(polygon, a)) return 0.0;
  double nearest = infinity;
  for (std::size_t k = 0; k < polygon.size(); ++k)
    nearest = std::min(nearest, between_segments(a, b, polygon[k], polygon[(k + 1) % polygon.size()]));
  return nearest;
}

}  // namespace

double Scene::clearance(const Point<double>& a, const Point<double>& b) const {
  double nearest = infinity;
  for (const Corner& p : {a, b})
    nearest = std::min({nearest, p.x - lower.x, upper.x - p.x, p.y - lower.y, upper.y - p.y});
  for (const Disc& disc : discs)
    nearest = std::min(nearest, distance_from_segment(disc.centre, a, b) - disc.radius);
  for (const Polygon& polygon : polygons) nearest = std::min(nearest, from_polygon(polygon, a, b));
  return nearest;
}

}  // namespace flyball
