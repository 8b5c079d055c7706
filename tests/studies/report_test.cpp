#include <algorithm>
#include <cmath>

#include "studies/file.h"
#include "studies/report/model_of_result.h"
#include "studies/report/one_axis.h"
#include "studies/report/path_drawing.h"
#include "studies/report/run_report.h"
#include "studies/report/text_table.h"
#include "studies/report/thinning.h"
#include "studies/shell.h"
#include "tests/catch.h"
#include "tests/studies/temporary_folder.h"

using namespace flyball;

namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("Report: thinned curves keep their extremes, ends and jumps") {
  HtmlFigure::Panel panel{"y", {}, {{"a", {}}, {"b", {}}}};
  for (int k = 0; k <= 100'000; ++k) {
    panel.x.push_back(k * 1e-4);
    panel.curves[0].y.push_back(k == 12'345 ? 7.0 : std::sin(k * 1e-3));
    panel.curves[1].y.push_back(k == 54'321 ? -9.0 : k < 5000 ? missing : 1.0);
  }
  const HtmlFigure::Panel thin = thinned(panel, 100);
  CHECK(thin.x.size() < 100 * 6);
  CHECK(thin.x.front() == panel.x.front());
  CHECK(thin.x.back() == panel.x.back());
  CHECK(std::ranges::is_sorted(thin.x));
  CHECK(std::ranges::max(thin.curves[0].y) == 7.0);
  CHECK(std::ranges::find(thin.curves[1].y, -9.0) != thin.curves[1].y.end());
  // Nothing is left out of what is small already.
  CHECK(thinned(thin, 1000).x.size() == thin.x.size());
}

TEST_CASE("Report: curves on several grids meet on one axis, jumps stay") {
  const HtmlFigure::Panel panel = on_one_axis(
      "y", {{"a", {0.0, 1.0, 1.0, 2.0}, {0.0, 1.0, 5.0, 6.0}}, {"b", {0.0, 1.5, 2.0}, {3.0, 4.0, 5.0}}});
  CHECK(panel.x == std::vector{0.0, 1.0, 1.0, 1.5, 2.0});
  CHECK(panel.curves[0].y[2] == 5.0);
  CHECK(std::isnan(panel.curves[0].y[3]));
  CHECK(panel.curves[1].y[0] == 3.0);
  CHECK(std::isnan(panel.curves[1].y[1]));
  CHECK(panel.curves[1].y[4] == 5.0);
}

TEST_CASE("Report: points without an order are put in one") {
  const HtmlFigure::Panel panel =
      on_one_axis("y", {{"a", {3.0, 1.0, missing, 2.0}, {30.0, 10.0, 0.0, 20.0}}});
  CHECK(panel.x == std::vector{1.0, 2.0, 3.0});
  CHECK(panel.curves[0].y == std::vector{10.0, 20.0, 30.0});
}

TEST_CASE("Report: a way keeps its end and its turns on the spot") {
  HtmlPath::Way way{"robot", {}, {}, {}, {}};
  for (int k = 0; k <= 10'000; ++k) {
    way.time.push_back(k * 1e-3);
    way.x.push_back(std::min(k, 5000) * 1e-3);
    way.y.push_back(0.0);
    way.heading.push_back(k > 5000 ? (k - 5000) * 1e-3 : 0.0);
  }
  const HtmlPath::Way thin = thinned(way, 100);
  CHECK(thin.x.size() < 250);
  CHECK(thin.time.back() == 10.0);
  CHECK(std::ranges::count_if(thin.time, [](double t) { return t > 5.0; }) > 40);
}

TEST_CASE("Report: a plane has one scale for both axes") {
  const HtmlPath path{"", "m", {{"robot", {0.0, 1.0}, {0.0, 4.0}, {0.0, 1.0}, {}}}, {{0.0, 0.0}, {4.0, 2.0}}};
  const PathScale scale = scale_of(path);
  CHECK(scale.x(1.0) - scale.x(0.0) == Approx(scale.y(0.0) - scale.y(1.0)));
  const std::string svg = path_svg(path, scale);
  CHECK(has(svg, "class=\"waypoint\""));
  CHECK(has(svg, "[m]"));
}

TEST_CASE("Report: a way that is one point, or none, is drawn") {
  const HtmlPath::Way still{"robot", {0.0, 1.0}, {2.0, 2.0}, {3.0, 3.0}, {0.0, 0.0}};
  for (const HtmlPath& path : {HtmlPath{"", "m", {still}, {}}, HtmlPath{"", "m", {}, {}}}) {
    const std::string svg = path_svg(path, scale_of(path));
    CHECK_FALSE(has(svg, "nan"));
    CHECK_FALSE(has(svg, "inf"));
  }
}

TEST_CASE("Report: columns of a pose are a way, others are none") {
  const std::vector<LogColumn> columns{{"a.x", "m", -1},        {"a.y", "m", -1},
                                       {"a.theta", "1", -1},    {"lorenz.x", "any", -1},
                                       {"lorenz.y", "any", -1}, {"lorenz.z", "any", -1}};
  const ResultCurves curves{{0.0}, {{1.0}, {2.0}, {3.0}, {4.0}, {5.0}, {6.0}}};
  const auto paths = robot_paths(columns, curves);
  REQUIRE(paths.size() == 1);
  CHECK(paths[0].ways[0].label == "a");
  CHECK(paths[0].ways[0].heading == std::vector{3.0});
}

TEST_CASE("Report: no text can leave its place in the page") {
  const std::string bad = "</script></title>\"'<blink>&\x01\xff";
  HtmlPage page{bad, bad, {{bad, true}}, {}};
  HtmlFigure figure{bad, bad, {{bad, {0.0, 1.0}, {{bad, {missing, 1.0}}}}}, false};
  HtmlPath path{bad, bad, {{bad, {0.0}, {0.0}, {0.0}, {}}}, {}};
  page.sections.push_back(
      {bad, {HtmlText{bad}, HtmlTable{{bad}, {{bad}}, {}}, figure, path, HtmlListing{bad}}});
  const std::string html = to_html(page);
  CHECK_FALSE(has(html, "</script></title>"));
  CHECK_FALSE(has(html, "<blink>"));
  CHECK(has(html, "[null,1]"));
  CHECK(to_html(page) == html);
}

TEST_CASE("Report: tables of a study are read with their quotes") {
  const test::TemporaryFolder folder;
  write_file(folder / "a.csv",
             "case,text,mean,unit\nhand,\"a, \"\"b\"\"\",0.123456789,V\nfitted,\"\",nan,V\n");
  const TextTable table = read_text_table(folder / "a.csv");
  CHECK(table.rows.at(0).at(1) == "a, \"b\"");
  CHECK(table.rows.at(1).at(1).empty());
  CHECK(std::isnan(table.numbers(2).at(1)));
  CHECK(html_table(table).rows.at(0).at(2) == "0.123457");
  CHECK(html_table(table).rows.at(1).at(2) == "none");
}

TEST_CASE("Report: columns that say the same in all rows are left out") {
  const TextTable table{{"model", "case", "mean"}, {{"servo", "a", "1"}, {"servo", "b", "2"}}};
  CHECK(html_table(table).header == std::vector<std::string>{"case", "mean"});
  CHECK(html_table({{"model", "mean"}, {{"servo", "1"}}}).header.size() == 2);
}

TEST_CASE("Report: commands can be pasted into a shell") {
  CHECK(shell_quoted("models/a.toml") == "models/a.toml");
  CHECK(shell_quoted("V=400 mm/s") == "'V=400 mm/s'");
  CHECK(shell_quoted("it's") == "'it'\\''s'");
  CHECK(shell_quoted("") == "''");
}
