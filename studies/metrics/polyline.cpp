#include "studies/metrics/polyline.h"

#include <algorithm>
#include <cmath>

#include "models/language/units.h"
#include "studies/metrics/data_table.h"

namespace flyball {

std::pair<Point, Point> Polyline::leg(double index) const {
  const auto last = static_cast<double>(points.size() - 1);
  const auto end = static_cast<std::size_t>(std::clamp(std::round(index), 1.0, last));
  return {points[end - 1], points[end]};
}

double segment_distance(Point p, const std::pair<Point, Point>& leg) {
  const auto& [a, b] = leg;
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double square = dx * dx + dy * dy;
  const double along = square > 0.0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / square : 0.0;
  const double part = std::clamp(along, 0.0, 1.0);
  return std::hypot(p.x - a.x - part * dx, p.y - a.y - part * dy);
}

double line_distance(Point p, const std::pair<Point, Point>& leg) {
  const auto& [a, b] = leg;
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  if (length == 0.0) return std::hypot(p.x - a.x, p.y - a.y);
  return std::fabs((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) / length;
}

double distance(Point p, const Polyline& path) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k + 1 < path.points.size(); ++k)
    least = std::min(least, segment_distance(p, {path.points[k], path.points[k + 1]}));
  return least;
}

Polyline read_polyline(const std::filesystem::path& file) {
  const DataTable table(file);
  const DataColumn x = table.column("x"), y = table.column("y");
  if (x.unit != y.unit) throw std::runtime_error(file.string() + ":1:1: error: x and y have different units");
  if (x.values.size() < 2)
    throw std::runtime_error(file.string() + ":1:1: error: a path has at least two points");
  Polyline path{{}, x.unit};
  for (std::size_t k = 0; k < x.values.size(); ++k) path.points.push_back({x.values[k], y.values[k]});
  return path;
}

}  // namespace flyball
