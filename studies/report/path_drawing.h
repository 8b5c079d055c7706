#pragma once

#include <array>
#include <string>
#include <string_view>

#include "studies/report/html_page.h"

namespace flyball {

/// The colours of curves and ways, which people with any colour vision tell apart (Okabe, Ito 2008).
inline constexpr std::array<std::string_view, 6> curve_colours{"#0072b2", "#d55e00", "#009e73",
                                                               "#cc79a7", "#e69f00", "#56b4e9"};

/// From the plane to the drawing: pixels = origin + scale * metres, y upwards.
struct PathScale {
  double left = 0.0, bottom = 0.0;  // pixels of the origin of the plane
  double scale = 1.0;               // pixels a unit
  int width = 0, height = 0;

  double x(double at) const { return left + scale * at; }
  double y(double at) const { return bottom - scale * at; }
};

PathScale scale_of(const HtmlPath& path);

/// Axes, ways and waypoints as SVG, with a mark of each way that a script can move.
std::string path_svg(const HtmlPath& path, const PathScale& scale);

}  // namespace flyball
