#include "studies/report/one_axis.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flyball {
namespace {

struct Sample {
  double x;
  std::size_t curve;
  double y;
};

std::vector<Sample> sorted(const std::vector<GridCurve>& curves) {
  std::vector<Sample> samples;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    for (std::size_t k = 0; k < curves[c].x.size(); ++k) {
      if (std::isfinite(curves[c].x[k])) samples.push_back({curves[c].x[k], c, curves[c].y[k]});
    }
  }
  std::ranges::stable_sort(samples, {}, &Sample::x);
  return samples;
}

}  // namespace

HtmlFigure::Panel on_one_axis(const std::string& label, const std::vector<GridCurve>& curves) {
  HtmlFigure::Panel panel{label, {}, {}};
  for (const GridCurve& curve : curves) panel.curves.push_back({curve.label, {}});
  std::vector<std::size_t> rows(curves.size(), 0);  // that each curve has filled
  for (const Sample& sample : sorted(curves)) {
    std::vector<double>& y = panel.curves[sample.curve].y;
    // The first row of this x that the curve has not yet filled.
    std::size_t row = panel.x.size();
    while (row > rows[sample.curve] && panel.x[row - 1] == sample.x) --row;
    if (row == panel.x.size()) {
      panel.x.push_back(sample.x);
      for (HtmlFigure::Curve& curve : panel.curves)
        curve.y.push_back(std::numeric_limits<double>::quiet_NaN());
    }
    y[row] = sample.y;
    rows[sample.curve] = row + 1;
  }
  return panel;
}

}  // namespace flyball
