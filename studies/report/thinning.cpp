#include "studies/report/thinning.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

std::vector<double> selected(const std::vector<double>& values, const std::vector<std::size_t>& rows) {
  std::vector<double> result;
  for (const std::size_t row : rows) result.push_back(values[row]);
  return result;
}

/// Rows from `begin` to `end` in which a curve has its least and largest value.
void add_extremes(const std::vector<double>& y, std::size_t begin, std::size_t end,
                  std::vector<std::size_t>& rows) {
  std::size_t least = end, largest = end;
  for (std::size_t k = begin; k < end; ++k) {
    if (std::isnan(y[k])) continue;
    if (least == end || y[k] < y[least]) least = k;
    if (largest == end || y[k] > y[largest]) largest = k;
  }
  if (least == end) return;
  rows.push_back(least);
  rows.push_back(largest);
}

}  // namespace

HtmlFigure::Panel thinned(const HtmlFigure::Panel& panel, int parts) {
  const std::size_t rows = panel.x.size();
  if (rows <= 2 * static_cast<std::size_t>(parts)) return panel;
  const double start = panel.x.front(), width = (panel.x.back() - start) / parts;
  std::vector<std::size_t> kept;
  std::size_t begin = 0;
  for (int part = 1; part <= parts; ++part) {
    std::size_t end = begin;
    while (end < rows && (part == parts || panel.x[end] < start + part * width)) ++end;
    if (end == begin) continue;
    kept.push_back(begin);
    kept.push_back(end - 1);
    for (const HtmlFigure::Curve& curve : panel.curves) add_extremes(curve.y, begin, end, kept);
    begin = end;
  }
  std::ranges::sort(kept);
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  HtmlFigure::Panel result{panel.label, selected(panel.x, kept), {}};
  for (const HtmlFigure::Curve& curve : panel.curves)
    result.curves.push_back({curve.label, selected(curve.y, kept)});
  return result;
}

HtmlPath::Way thinned(const HtmlPath::Way& way, int parts) {
  if (way.x.size() <= static_cast<std::size_t>(parts)) return way;
  const auto [left, right] = std::ranges::minmax(way.x);
  const auto [low, high] = std::ranges::minmax(way.y);
  const double near = std::hypot(right - left, high - low) / parts;
  const double brief = (way.time.back() - way.time.front()) / parts;
  std::vector<std::size_t> kept{0};
  for (std::size_t k = 1; k < way.x.size(); ++k) {
    const std::size_t last = kept.back();
    const bool far = std::hypot(way.x[k] - way.x[last], way.y[k] - way.y[last]) >= near;
    // A robot that turns on the spot is seen, too.
    if (far || way.time[k] - way.time[last] >= brief || k + 1 == way.x.size()) kept.push_back(k);
  }
  HtmlPath::Way result{way.label, selected(way.time, kept), selected(way.x, kept), selected(way.y, kept), {}};
  if (!way.heading.empty()) result.heading = selected(way.heading, kept);
  return result;
}

}  // namespace flyball
