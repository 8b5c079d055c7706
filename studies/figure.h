#pragma once

#include <string>
#include <vector>

#include "solvers/log.h"

namespace flyball {

/// One line of a figure: a column of a CSV file over its first column.
struct Curve {
  std::string csv;  // file name, in the folder of the script
  int column = 2;   // counted from 1, as gnuplot counts
  std::string label;
  double factor = 1.0;  // from SI to the unit of the panel
  bool points = false;  // instead of a line
};

struct Panel {
  std::string label;  // of the vertical axis, with its unit
  std::vector<Curve> curves;
};

/// Panels below each other, with one axis of time [s].
struct Figure {
  std::string title;
  std::vector<Panel> panels;
  double end = 0.0;  // of the axis of time; 0: as far as the data go
};

/// A figure of all columns of a result: one panel a unit, in the order of the columns.
/// Signals whose unit is not known have a panel each, unless they are many.
Figure figure_of(const std::vector<LogColumn>& columns, const std::string& title, const std::string& csv);

/// A gnuplot script for people to restyle. It is run in its folder and draws STEM.svg, or STEM.png with
/// `gnuplot -e "format = 'png'"`.
std::string gnuplot_script(const Figure& figure, const std::string& stem);

/// How every script begins: its terminal, svg or png, of a height in pixels, and its colours.
std::string gnuplot_opening(const std::string& stem, int height);

/// "name [unit]", or the one of them that there is.
std::string axis_label(const std::string& name, const std::string& unit);

/// 'text' for gnuplot, which reads nothing in single quotes but the quote itself.
std::string gnuplot_quoted(const std::string& text);

}  // namespace flyball
