#include "studies/report/study_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "blocks/hash.h"
#include "models/read_file.h"
#include "studies/file.h"
#include "studies/metadata.h"
#include "studies/report/model_of_result.h"
#include "studies/report/one_axis.h"
#include "studies/report/text_table.h"
#include "studies/shell.h"

namespace flyball {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Mark = HtmlTable::Mark;

class StudyReport {
 public:
  StudyReport(fs::path folder, const Json& json) : folder_(std::move(folder)), json_(json) {}

  HtmlPage page() {
    const std::string file = json_.at("study").at("file"), title = json_.at("study").at("title");
    HtmlPage page{title.empty() ? fs::path(file).filename().string() : title, subtitle(), {}, {}};
    add_requirements(page);
    add_table(page, "Metrics", "summary.csv");
    add_table(page, "Differences between cases", "comparison.csv");
    add_fronts(page);
    add_plots(page);
    page.sections.push_back(cases());
    for (const Json& model : json_.at("models")) page.sections.push_back(section_of(model));
    page.sections.push_back(study_file(file));
    page.sections.push_back(again(file));
    return page;
  }

  std::vector<std::string> warnings() const { return warnings_; }

 private:
  bool has(const char* name) const { return json_.at("files").contains(name); }

  std::string subtitle() const {
    const auto count = [](std::size_t n, const char* thing) {
      return fmt::format("{} {}{}", n, thing, n == 1 ? "" : "s");
    };
    std::string text = count(json_.at("runs"), "run") + ": " + count(json_.at("cases").size(), "case") +
                       ", " + count(json_.at("scenarios").size(), "scenario");
    if (json_.at("sweep_points") > 1) text += ", " + count(json_.at("sweep_points"), "sweep point");
    if (json_.at("samples") > 1) text += ", " + count(json_.at("samples"), "sample");
    return text;
  }

  void add_requirements(HtmlPage& page) const {
    if (const long failed = json_.at("failed"); failed > 0)
      page.verdicts.emplace_back(fmt::format("{} runs were stopped", failed), false);
    if (!has("requirements.csv")) return;
    const TextTable found = read_text_table(folder_ / "requirements.csv");
    HtmlTable table{{"Requirement", "Runs that pass", "Text", "Worst margin", "Unit", "Worst found"}, {}, {}};
    long broken = 0;
    for (const auto& row : found.rows) {
      const auto cell = [&](const char* name) { return row.at(static_cast<std::size_t>(found.find(name))); };
      const bool holds = cell("passed") == cell("runs");
      broken += holds ? 0 : 1;
      table.rows.push_back({cell("requirement"), fmt::format("{} of {}", cell("passed"), cell("runs")),
                            cell("text"), cell("worst margin"), cell("unit"), cell("message")});
      table.marks.push_back(holds ? Mark::passed : Mark::failed);
    }
    page.verdicts.emplace_back(
        broken == 0 ? fmt::format("{} of {} requirements hold", table.rows.size(), table.rows.size())
                    : fmt::format("{} of {} requirements broken", broken, table.rows.size()),
        broken == 0);
    page.sections.push_back({"Requirements", {std::move(table)}});
  }

  void add_table(HtmlPage& page, const char* title, const char* file) const {
    if (!has(file)) return;
    const TextTable found = read_text_table(folder_ / file);
    HtmlSection section{title, {html_table(found)}};
    if (const std::size_t shown = std::get<HtmlTable>(section.items[0]).rows.size();
        shown < found.rows.size())
      section.items.emplace_back(
          HtmlText{fmt::format("{} more rows are in {}.", found.rows.size() - shown, file)});
    page.sections.push_back(std::move(section));
  }

  void add_fronts(HtmlPage& page) const {
    for (const auto& [name, checksum] : json_.at("files").items()) {
      if (!name.starts_with("pareto-") || !name.ends_with(".csv")) continue;
      page.sections.push_back(
          {"Front: " + name.substr(7, name.size() - 11), {html_table(read_text_table(folder_ / name))}});
    }
  }

  void add_plots(HtmlPage& page) const {
    if (!json_.contains("plots") || json_.at("plots").empty()) return;
    HtmlSection section{"Figures", {}};
    for (const Json& plot : json_.at("plots")) section.items.emplace_back(drawn(plot));
    page.sections.push_back(std::move(section));
  }

  HtmlItem drawn(const Json& plot) const {
    HtmlFigure figure{plot.at("title"), plot.at("x_label"), {}, false};
    for (const Json& panel : plot.at("panels")) {
      std::vector<GridCurve> curves;
      for (const Json& curve : panel.at("curves")) {
        const TextTable table = read_text_table(folder_ / curve.at("csv").get<std::string>());
        const int x = curve.at("x").get<int>() - 1, y = curve.at("column").get<int>() - 1;
        if (const auto way = way_of(table, x, y, curve.at("label")); way && plot.at("panels").size() == 1)
          return way_together(plot);
        curves.push_back({curve.at("label"), table.numbers(x), table.numbers(y)});
        for (double& value : curves.back().y) value *= curve.at("factor").get<double>();
        figure.points = figure.points || curve.at("points").get<bool>();
      }
      figure.panels.push_back(on_one_axis(panel.at("label"), curves));
    }
    return figure;
  }

  /// P.y over P.x of a table that has P.theta, too, is the way of a robot.
  static std::optional<HtmlPath::Way> way_of(const TextTable& table, int x, int y, const std::string& label) {
    const std::string& name = table.header[static_cast<std::size_t>(x)];
    if (name != "x" && !name.ends_with(".x")) return std::nullopt;
    const std::string stem = name.substr(0, name.size() - 1);
    if (table.header[static_cast<std::size_t>(y)] != stem + "y") return std::nullopt;
    HtmlPath::Way way{label, table.numbers(0), table.numbers(x), table.numbers(y), {}};
    for (const char* heading : {"theta", "heading", "psi"}) {
      if (const int column = table.find(stem + heading); column >= 0) way.heading = table.numbers(column);
    }
    return way;
  }

  HtmlPath way_together(const Json& plot) const {
    HtmlPath path{plot.at("title"), "m", {}, {}};
    for (const Json& curve : plot.at("panels").at(0).at("curves")) {
      const TextTable table = read_text_table(folder_ / curve.at("csv").get<std::string>());
      const auto way =
          way_of(table, curve.at("x").get<int>() - 1, curve.at("column").get<int>() - 1, curve.at("label"));
      if (way && !way->time.empty()) path.ways.push_back(*way);
    }
    return path;
  }

  static std::string settings_of(const Json& choice) {
    std::string text;
    for (const auto& [name, value] : choice.at("set").items()) {
      const std::string shown =
          value.is_string() ? value.get<std::string>() : fmt::format("{:.6g}", value.get<double>());
      text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", name, shown);
    }
    return text;
  }

  HtmlSection cases() const {
    HtmlSection section{"Cases and scenarios", {}};
    for (const auto& [key, title] : {std::pair("cases", "Case"), std::pair("scenarios", "Scenario")}) {
      HtmlTable table{{title, "Sets", "Found by"}, {}, {}};
      for (const Json& choice : json_.at(key))
        table.rows.push_back({choice.at("name"), settings_of(choice), choice.value("from", "")});
      section.items.emplace_back(std::move(table));
    }
    return section;
  }

  HtmlSection section_of(const Json& model) {
    const std::string file = model.at("file"), hash = model.at("hash"), title = model.at("title");
    HtmlTable facts{{"", ""}, {{"file", file}, {"hash", hash}}, {}};
    if (!title.empty()) facts.rows.insert(facts.rows.begin(), {"title", title});
    HtmlSection section{"Model " + model.at("name").get<std::string>(), {std::move(facts)}};
    const UnchangedModel found = find_model(file, hash, {});
    if (found.plan == nullptr) {
      section.items.emplace_back(HtmlText{"The model's file is not there any more, or has changed since."});
      return section;
    }
    const std::string svg = drawn_diagram(*found.plan, folder_ / "diagram", warnings_);
    if (!svg.empty()) section.items.emplace_back(HtmlDrawing{svg});
    section.items.emplace_back(HtmlListing{found.text});
    return section;
  }

  HtmlSection study_file(const std::string& file) const {
    const auto text = read_file_content(file);
    HtmlSection section{"Study file",
                        {HtmlTable{{"", ""}, {{"file", file}, {"hash", json_.at("study").at("hash")}}, {}}}};
    if (text && fingerprint(*text) == json_.at("study").at("hash")) {
      section.items.emplace_back(HtmlListing{*text});
    } else {
      section.items.emplace_back(HtmlText{"The study's file is not there any more, or has changed since."});
    }
    return section;
  }

  HtmlSection again(const std::string& file) const {
    HtmlTable versions{{"Made with", "Version"}, {{"Flyball", json_.at("flyball")}}, {}};
    for (const auto& [name, number] : json_.at("libraries").items()) versions.rows.push_back({name, number});
    return {"Run it again",
            {HtmlListing{fmt::format("flyball study {} --output {} --report", shell_quoted(file),
                                     shell_quoted(folder_.string()))},
             std::move(versions)}};
  }

  fs::path folder_;
  const Json& json_;
  std::vector<std::string> warnings_;
};

Json read_json(const fs::path& file) {
  try {
    return Json::parse(read_file(file));
  } catch (const Json::exception&) {
    throw MetadataError(file.string() + ": not the metadata of a study");
  }
}

}  // namespace

std::vector<std::string> write_study_report(const fs::path& folder, const fs::path& html) {
  const Json json = read_json(folder / "study.json");
  try {
    StudyReport report(folder, json);
    const HtmlPage page = report.page();
    write_file(html, to_html(page));
    return report.warnings();
  } catch (const Json::exception&) {
    throw MetadataError((folder / "study.json").string() + ": not the metadata of a study");
  }
}

}  // namespace flyball
