#pragma once

#include <string>
#include <utility>
#include <vector>

#include "studies/report/html_page.h"

namespace flyball {

/// A curve with its own grid.
struct GridCurve {
  std::string label;
  std::vector<double> x, y;
};

/// Curves on one axis: a row for each x, NaN where a curve has no point there. Two rows of one x are a jump.
HtmlFigure::Panel on_one_axis(const std::string& label, const std::vector<GridCurve>& curves);

}  // namespace flyball
