#include "studies/report/path_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "studies/xml.h"

namespace flyball {
namespace {

constexpr int wide = 880, tall = 560, margin = 48;

struct Bounds {
  double left = std::numeric_limits<double>::infinity(), right = -left;
  double low = left, high = -left;

  void include(double x, double y) {
    left = std::min(left, x);
    right = std::max(right, x);
    low = std::min(low, y);
    high = std::max(high, y);
  }
};

Bounds bounds_of(const HtmlPath& path) {
  Bounds bounds;
  for (const HtmlPath::Way& way : path.ways) {
    for (std::size_t k = 0; k < way.x.size(); ++k) bounds.include(way.x[k], way.y[k]);
  }
  for (const auto& [x, y] : path.waypoints) bounds.include(x, y);
  if (bounds.left > bounds.right) bounds.include(0.0, 0.0);
  // A way along an axis has room beside it.
  const double size = std::max({bounds.right - bounds.left, bounds.high - bounds.low, 1e-9});
  const double room = 0.08 * size;
  return {bounds.left - room, bounds.right + room, bounds.low - room, bounds.high + room};
}

/// 1, 2 or 5 times a power of ten, of which about eight fit.
double tick_of(double span) {
  const double rough = span / 8.0, power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough) return factor * power;
  }
  return 10.0 * power;
}

std::string grid(const PathScale& scale, const std::string& unit) {
  const double tick = tick_of(std::max(scale.width, scale.height) / scale.scale);
  std::string svg = "<g class=\"grid\">";
  const auto out = std::back_inserter(svg);
  const double right = scale.width, bottom = scale.height - margin;
  // In labels, the sum with 0 makes a plain zero of -0.
  for (double k = std::ceil((margin - scale.left) / scale.scale / tick); scale.x(k * tick) <= right - 8;
       ++k) {
    const double x = scale.x(k * tick);
    fmt::format_to(out, "<line x1=\"{0:.2f}\" y1=\"8\" x2=\"{0:.2f}\" y2=\"{1:.2f}\"/>", x, bottom);
    fmt::format_to(out, "<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\">{:.6g}</text>", x,
                   bottom + 18, k * tick + 0.0);
  }
  for (double k = std::ceil((scale.bottom - bottom) / scale.scale / tick); scale.y(k * tick) >= 8; ++k) {
    const double y = scale.y(k * tick);
    fmt::format_to(out, "<line x1=\"{1}\" y1=\"{0:.2f}\" x2=\"{2:.2f}\" y2=\"{0:.2f}\"/>", y, margin,
                   right - 8);
    fmt::format_to(out, "<text x=\"{}\" y=\"{:.2f}\" text-anchor=\"end\">{:.6g}</text>", margin - 6, y + 4,
                   k * tick + 0.0);
  }
  fmt::format_to(out, "<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"end\">{}</text></g>", right - 8,
                 bottom + 36, unit.empty() ? "" : "[" + xml_text(unit) + "]");
  return svg;
}

std::string points(const PathScale& scale, auto&& all) {
  std::string text;
  for (const auto& [x, y] : all)
    fmt::format_to(std::back_inserter(text), "{:.2f},{:.2f} ", scale.x(x), scale.y(y));
  return text;
}

std::vector<std::pair<double, double>> points_of(const HtmlPath::Way& way) {
  std::vector<std::pair<double, double>> all;
  for (std::size_t k = 0; k < way.x.size(); ++k) all.emplace_back(way.x[k], way.y[k]);
  return all;
}

/// A body with its nose towards +x, or a disc.
std::string mark(const HtmlPath::Way& way, std::string_view colour) {
  const std::string body = way.heading.empty()
                               ? "<circle r=\"6\"/>"
                               : "<rect x=\"-13\" y=\"-9\" width=\"26\" height=\"18\" rx=\"4\"/>"
                                 "<path class=\"nose\" d=\"M 3 -6 L 10 0 L 3 6 Z\"/>";
  return fmt::format("<g class=\"mark\" fill=\"{}\">{}</g>", colour, body);
}

}  // namespace

PathScale scale_of(const HtmlPath& path) {
  const Bounds bounds = bounds_of(path);
  PathScale scale;
  scale.scale = std::min((wide - margin - 8) / (bounds.right - bounds.left),
                         (tall - margin - 8) / (bounds.high - bounds.low));
  scale.left = margin - scale.scale * bounds.left;
  scale.bottom = 8 + scale.scale * bounds.high;
  scale.width = static_cast<int>(std::ceil(scale.x(bounds.right))) + 8;
  scale.height = static_cast<int>(std::ceil(scale.y(bounds.low))) + margin;
  return scale;
}

std::string path_svg(const HtmlPath& path, const PathScale& scale) {
  std::string svg = fmt::format(
      "<svg class=\"path\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" role=\"img\" aria-label=\"{2}\">",
      scale.width, scale.height, xml_attribute(path.title));
  const auto out = std::back_inserter(svg);
  svg += grid(scale, path.unit);
  if (!path.waypoints.empty()) {
    fmt::format_to(out, "<polyline class=\"waypoints\" points=\"{}\"/>", points(scale, path.waypoints));
    for (const auto& [x, y] : path.waypoints)
      fmt::format_to(out, "<circle class=\"waypoint\" cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"4\"/>", scale.x(x),
                     scale.y(y));
  }
  for (std::size_t k = 0; k < path.ways.size(); ++k) {
    fmt::format_to(out, "<polyline class=\"way\" stroke=\"{}\" points=\"{}\"/>",
                   curve_colours[k % curve_colours.size()], points(scale, points_of(path.ways[k])));
  }
  for (std::size_t k = 0; k < path.ways.size(); ++k)
    svg += mark(path.ways[k], curve_colours[k % curve_colours.size()]);
  return svg + "</svg>";
}

}  // namespace flyball
