#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace flyball {

/// A paragraph.
struct HtmlText {
  std::string text;
};

struct HtmlTable {
  enum class Mark { none, passed, failed };

  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  std::vector<Mark> marks;  // of rows; may be shorter
};

/// Curves over one axis, to zoom into and to compare.
struct HtmlFigure {
  struct Curve {
    std::string label;
    std::vector<double> y;
  };
  struct Panel {
    std::string label;      // of the vertical axis
    std::vector<double> x;  // of all its curves; never falls
    std::vector<Curve> curves;
  };

  std::string title;
  std::string x_label;
  std::vector<Panel> panels;  // below each other; a zoom into one is one into all
  bool points = false;        // without lines between them
};

/// Ways of points in a plane, in one scale for both axes; a time slider moves along them.
struct HtmlPath {
  struct Way {
    std::string label;
    std::vector<double> time, x, y;  // s
    std::vector<double> heading;     // rad; empty: a point without direction
  };

  std::string title;
  std::string unit;
  std::vector<Way> ways;
  std::vector<std::pair<double, double>> waypoints;  // of a path to follow
};

/// An SVG drawing that is part of the page.
struct HtmlDrawing {
  std::string svg;
};

/// Text as it stands: a model, a command.
struct HtmlListing {
  std::string text;
};

using HtmlItem = std::variant<HtmlText, HtmlTable, HtmlFigure, HtmlPath, HtmlDrawing, HtmlListing>;

struct HtmlSection {
  std::string title;
  std::vector<HtmlItem> items;
};

struct HtmlPage {
  std::string title;
  std::string subtitle;
  std::vector<std::pair<std::string, bool>> verdicts;  // label, and whether it is good
  std::vector<HtmlSection> sections;
};

/// One file of HTML that needs no network: style, scripts and dygraphs are in it. The same page gives the
/// same bytes. Curves are thinned to what a screen shows, so that the file stays below 2 MB.
std::string to_html(const HtmlPage& page);

}  // namespace flyball
