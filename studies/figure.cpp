#include "studies/figure.h"

#include <fmt/format.h>

#include <algorithm>

namespace flyball {
namespace {

// More lines than this cannot be told apart by a legend.
constexpr std::size_t longest_legend = 12;

// More panels than this are too many to look at.
constexpr long most_single_panels = 6;

constexpr std::string_view style = R"(if (!exists("format")) format = 'svg'
if (!exists("figure")) figure = stem . '.' . format
if (format eq 'png') {{
  # Twice the size with everything on it: a curve that is nearly level shows its pixels else.
  set terminal pngcairo size 2400,{height} font 'DejaVu Sans,13' fontscale 2 linewidth 2 background '#ffffff'
}} else {{
  set terminal svg size 900,{svg_height} font 'DejaVu Sans,12' background '#ffffff'
}}
set output figure

# Colours that people with any colour vision tell apart (Okabe, Ito 2008).
set linetype 1 lc rgb '#0072b2' lw 2
set linetype 2 lc rgb '#d55e00' lw 2
set linetype 3 lc rgb '#009e73' lw 2
set linetype 4 lc rgb '#cc79a7' lw 2
set linetype 5 lc rgb '#e69f00' lw 2
set linetype 6 lc rgb '#56b4e9' lw 2
set linetype cycle 6
set border 3 lc rgb '#555555'
set tics nomirror out textcolor rgb '#333333'
set grid lc rgb '#dddddd' lt 1 lw 1
set key at graph 1.02, graph 1 left top Left reverse samplen 2 noenhanced
set datafile separator comma
)";

bool has_legend(const Panel& panel) {
  return panel.curves.size() > 1 && panel.curves.size() <= longest_legend;
}

/// Room to the right of all panels, in characters.
std::size_t legend_width(const Figure& figure) {
  std::size_t width = 3;
  for (const Panel& panel : figure.panels) {
    if (!has_legend(panel)) continue;
    for (const Curve& curve : panel.curves) width = std::max(width, curve.label.size() + 8);
  }
  return std::min<std::size_t>(width, 40);
}

std::string panel_script(const Panel& panel, const std::string& x_label) {
  const bool legend = has_legend(panel);
  std::string script = fmt::format("\nset ylabel {} noenhanced\n", gnuplot_quoted(panel.label));
  if (!x_label.empty())
    script += fmt::format("set xlabel {} noenhanced\nset format x '%g'\n", gnuplot_quoted(x_label));
  script += "plot";
  for (const Curve& curve : panel.curves) {
    const bool is_first = &curve == &panel.curves.front();
    const std::string value = curve.factor == 1.0 ? fmt::format("{}", curve.column)
                                                  : fmt::format("(${}*{})", curve.column, curve.factor);
    script +=
        fmt::format("{}{} using {}:{} skip 1 with {} {}", is_first ? " " : ", \\\n     ",
                    gnuplot_quoted(curve.csv), curve.x, value, curve.points ? "points pt 7 ps 0.7" : "lines",
                    legend ? "title " + gnuplot_quoted(curve.label) : "notitle");
  }
  return script + '\n';
}

}  // namespace

std::string axis_label(const std::string& name, const std::string& unit) {
  if (unit.empty() || unit == "any" || unit == "1") return name;
  return name.empty() ? fmt::format("[{}]", unit) : fmt::format("{} [{}]", name, unit);
}

std::string gnuplot_opening(const std::string& stem, int height) {
  return fmt::format(
             "# Run in this folder:  gnuplot FILE  or  gnuplot -e \"format = 'png'\" FILE\nstem = {}\n",
             gnuplot_quoted(stem)) +
         fmt::format(style, fmt::arg("height", 2 * height), fmt::arg("svg_height", height * 3 / 4));
}

std::string gnuplot_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') quoted += '\'';
    quoted += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return quoted + '\'';
}

Figure figure_of(const std::vector<LogColumn>& columns, const std::string& title, const std::string& csv) {
  const auto unknown = std::ranges::count(columns, "any", &LogColumn::unit);
  Figure figure{title, {}};
  std::vector<std::string> units;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    // Signals of unknown unit are most often of different size.
    const bool alone = columns[c].unit == "any" && unknown <= most_single_panels;
    const auto same = alone ? units.end() : std::ranges::find(units, columns[c].unit);
    const auto panel = static_cast<std::size_t>(same - units.begin());
    if (same == units.end()) {
      units.push_back(columns[c].unit);
      figure.panels.emplace_back();
    }
    figure.panels[panel].curves.push_back({csv, static_cast<int>(c) + 2, columns[c].name});
  }
  for (std::size_t p = 0; p < units.size(); ++p) {
    const auto& curves = figure.panels[p].curves;
    figure.panels[p].label = axis_label(curves.size() == 1 ? curves[0].label : "", units[p]);
  }
  return figure;
}

std::string gnuplot_script(const Figure& figure, const std::string& stem) {
  const auto panels = static_cast<int>(figure.panels.size());
  const int height = std::max(420, 300 * panels + 120);
  std::string script = gnuplot_opening(stem, height);
  if (figure.end > 0.0) script += fmt::format("set xrange [0:{}]\n", figure.end);
  script +=
      fmt::format("set multiplot layout {},1 title {} noenhanced\n", panels, gnuplot_quoted(figure.title));
  // Panels with and without a legend keep one width.
  script += fmt::format("set lmargin 11\nset rmargin {}\n", legend_width(figure));
  if (panels > 1) script += "set format x ''\n";
  for (const Panel& panel : figure.panels)
    script += panel_script(panel, &panel == &figure.panels.back() ? figure.x_label : "");
  return script + "\nunset multiplot\n";
}

}  // namespace flyball
