#include "studies/report/html_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>

#include "studies/report/assets.h"
#include "studies/report/path_drawing.h"
#include "studies/report/thinning.h"
#include "studies/xml.h"

namespace flyball {
namespace {

/// Numbers of all figures of a page, which take about ten bytes each.
constexpr int most_numbers = 120'000;
constexpr int most_parts = 1000, least_parts = 60, most_way_points = 1500;

/// Text in JSON in a script: nothing in it can end the script.
std::string json_text(std::string_view text) {
  std::string json = "\"";
  for (const char c : valid_text(text)) {
    const auto code = static_cast<unsigned char>(c);
    if (code < ' ' || c == '"' || c == '\\' || c == '<' || c == '>' || c == '&') {
      fmt::format_to(std::back_inserter(json), "\\u{:04x}", code);
    } else {
      json += c;
    }
  }
  return json + '"';
}

/// With the digits that a screen shows.
std::string json_numbers(const std::vector<double>& numbers, int digits) {
  std::string json = "[";
  for (const double x : numbers) {
    if (json.size() > 1) json += ',';
    if (std::isfinite(x)) {
      fmt::format_to(std::back_inserter(json), "{:.{}g}", x, digits);
    } else {
      json += "null";
    }
  }
  return json + ']';
}

bool is_number(std::string_view cell) {
  double value = 0.0;
  if (cell.starts_with('+')) cell.remove_prefix(1);
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error == std::errc() && end == cell.data() + cell.size();
}

/// How finely curves may be divided so that all of a page's fit.
int parts_for(const HtmlPage& page) {
  double numbers = 0.0;
  for (const HtmlSection& section : page.sections) {
    for (const HtmlItem& item : section.items) {
      const auto* figure = std::get_if<HtmlFigure>(&item);
      if (figure == nullptr) continue;
      for (const HtmlFigure::Panel& panel : figure->panels) {
        const auto curves = static_cast<double>(panel.curves.size());
        numbers += (2.0 * curves + 2.0) * (curves + 1.0);
      }
    }
  }
  return std::clamp(static_cast<int>(most_numbers / std::max(numbers, 1.0)), least_parts, most_parts);
}

class Writer {
 public:
  explicit Writer(int parts) : parts_(parts) {}

  void operator()(const HtmlText& item) { html_ += "<p>" + xml_text(item.text) + "</p>\n"; }

  void operator()(const HtmlTable& table) {
    html_ += "<div class=\"scroll\"><table>\n<thead><tr>";
    for (std::size_t c = 0; c < table.header.size(); ++c)
      html_ += fmt::format("<th{}>{}</th>", number_class(table, c), xml_text(table.header[c]));
    html_ += "</tr></thead>\n<tbody>\n";
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
      const auto mark = r < table.marks.size() ? table.marks[r] : HtmlTable::Mark::none;
      html_ += mark == HtmlTable::Mark::passed   ? "<tr class=\"passed\">"
               : mark == HtmlTable::Mark::failed ? "<tr class=\"failed\">"
                                                 : "<tr>";
      for (const std::string& cell : table.rows[r])
        html_ += fmt::format("<td{}>{}</td>", is_number(cell) ? " class=\"number\"" : "", xml_text(cell));
      html_ += "</tr>\n";
    }
    html_ += "</tbody></table></div>\n";
  }

  void operator()(const HtmlFigure& figure) {
    html_ += "<figure class=\"curves\">";
    if (!figure.title.empty()) html_ += "<figcaption>" + xml_text(figure.title) + "</figcaption>";
    html_ += fmt::format("<script type=\"application/json\">{{\"x\":{},\"points\":{},\"panels\":[",
                         json_text(figure.x_label), figure.points);
    bool first = true;
    for (const HtmlFigure::Panel& whole : figure.panels) {
      const HtmlFigure::Panel panel = figure.points ? whole : thinned(whole, parts_);
      html_ += fmt::format("{}{{\"label\":{},\"x\":{},\"curves\":[", first ? "" : ",", json_text(panel.label),
                           json_numbers(panel.x, 8));
      for (const HtmlFigure::Curve& curve : panel.curves)
        html_ += fmt::format("{}{{\"label\":{},\"y\":{}}}", &curve == panel.curves.data() ? "" : ",",
                             json_text(curve.label), json_numbers(curve.y, 5));
      html_ += "]}";
      first = false;
    }
    html_ += "]}</script></figure>\n";
  }

  void operator()(const HtmlPath& whole) {
    HtmlPath path = whole;
    for (HtmlPath::Way& way : path.ways) way = thinned(way, most_way_points);
    const PathScale scale = scale_of(path);
    html_ += "<figure class=\"plane\">";
    if (!path.title.empty()) html_ += "<figcaption>" + xml_text(path.title) + "</figcaption>";
    html_ += path_svg(path, scale);
    html_ += "<div class=\"key\">";
    for (std::size_t k = 0; k < path.ways.size(); ++k)
      html_ += fmt::format("<span><i style=\"background:{}\"></i>{}</span>",
                           curve_colours[k % curve_colours.size()], xml_text(path.ways[k].label));
    html_ += fmt::format(
        "</div><script "
        "type=\"application/json\">{{\"left\":{:.6g},\"bottom\":{:.6g},\"scale\":{:.6g},\"ways\":[",
        scale.left, scale.bottom, scale.scale);
    for (const HtmlPath::Way& way : path.ways)
      html_ += fmt::format("{}{{\"time\":{},\"x\":{},\"y\":{},\"heading\":{}}}",
                           &way == path.ways.data() ? "" : ",", json_numbers(way.time, 7),
                           json_numbers(way.x, 6), json_numbers(way.y, 6), json_numbers(way.heading, 5));
    html_ += "]}</script></figure>\n";
  }

  void operator()(const HtmlDrawing& drawing) {
    html_ += "<figure class=\"drawing\">" + drawing.svg + "</figure>\n";
  }

  void operator()(const HtmlListing& listing) { html_ += "<pre>" + xml_text(listing.text) + "</pre>\n"; }

  std::string take() { return std::move(html_); }

 private:
  static std::string_view number_class(const HtmlTable& table, std::size_t column) {
    const bool numbers = std::ranges::any_of(
        table.rows, [&](const auto& row) { return column < row.size() && is_number(row[column]); });
    return numbers ? " class=\"number\"" : "";
  }

  int parts_;
  std::string html_;
};

std::string navigation(const HtmlPage& page) {
  std::string html = "<nav>";
  for (std::size_t k = 0; k < page.sections.size(); ++k)
    html += fmt::format("<a href=\"#s{}\">{}</a>", k + 1, xml_text(page.sections[k].title));
  return html + "</nav>\n";
}

std::string heading(const HtmlPage& page) {
  std::string html = "<header>\n<h1>" + xml_text(page.title) + "</h1>\n";
  if (!page.subtitle.empty()) html += "<p class=\"subtitle\">" + xml_text(page.subtitle) + "</p>\n";
  if (!page.verdicts.empty()) html += "<p class=\"verdicts\">";
  for (const auto& [label, good] : page.verdicts)
    html += fmt::format("<span class=\"{}\">{}</span>", good ? "good" : "bad", xml_text(label));
  if (!page.verdicts.empty()) html += "</p>\n";
  return html + "</header>\n";
}

}  // namespace

std::string to_html(const HtmlPage& page) {
  std::string html = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  html += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  html += fmt::format("<title>{}</title>\n<style>\n{}\n{}</style>\n</head>\n<body>\n", xml_text(page.title),
                      asset::dygraph_css, asset::report_css);
  html += heading(page) + navigation(page) + "<main>\n";
  Writer writer(parts_for(page));
  for (std::size_t k = 0; k < page.sections.size(); ++k) {
    html += fmt::format("<section id=\"s{}\">\n<h2>{}</h2>\n", k + 1, xml_text(page.sections[k].title));
    for (const HtmlItem& item : page.sections[k].items) std::visit(writer, item);
    html += writer.take() + "</section>\n";
  }
  html += "</main>\n";
  html += fmt::format("<script>\n{}\n</script>\n<script>\n{}</script>\n</body>\n</html>\n", asset::dygraph_js,
                      asset::report_js);
  return html;
}

}  // namespace flyball
