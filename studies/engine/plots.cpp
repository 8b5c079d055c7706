#include "studies/engine/plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/csv.h"
#include "studies/figure.h"
#include "studies/file.h"

namespace flyball {
namespace {

namespace fs = std::filesystem;

int number_of(const auto& named, const std::string& name) {
  const auto found = std::ranges::find_if(named, [&](const auto& each) { return each.first == name; });
  return found == named.end() ? -1 : static_cast<int>(found - named.begin());
}

/// Part of a file's name.
std::string plain(std::string name) {
  std::ranges::replace_if(
      name, [](unsigned char c) { return std::isalnum(c) == 0 && c != '_' && c != '-' && c != '.'; }, '_');
  return name;
}

class Plotter {
 public:
  Plotter(const StudyData& data, const PlotDefinition& plot, Evaluator& evaluator, fs::path stem)
      : data_(data), plot_(plot), evaluator_(evaluator), stem_(std::move(stem)) {}

  void write(ResultFiles& written) {
    const bool of_runs = !plot_.x.empty() && (axis() >= 0 || metric(plot_.x) >= 0);
    Figure figure{plot_.title, {}};
    for (const std::string& signal : plot_.signals) figure.panels.push_back({signal, {}});
    for (const auto& [label, cell] : curves()) {
      const fs::path csv = fmt::format("{}-{}.csv", stem_.string(), plain(label));
      const std::string name = csv.filename().string();
      const std::string text =
          of_runs ? add_metrics(cell, label, name, figure) : add_signals(cell, label, name, figure);
      write_file(csv, text);
      written.files.push_back(csv);
    }
    draw(figure, written);
  }

 private:
  struct NamedCell {
    std::string label;
    RunPlace place;
  };

  int metric(const std::string& name) const { return number_of(data_.study.metrics, name); }
  int axis() const {
    const auto& axes = data_.study.sweep.axes;
    const auto found = std::ranges::find(axes, plot_.x, &Axis::name);
    return found == axes.end() ? -1 : static_cast<int>(found - axes.begin());
  }

  /// One for each value of what the curves tell apart; all else is the first.
  std::vector<NamedCell> curves() const {
    RunPlace place;
    const auto& scenarios = data_.study.scenarios;
    const auto scenario = std::ranges::find(scenarios, plot_.scenario, &Choice::name);
    if (scenario != scenarios.end()) place.scenario = static_cast<int>(scenario - scenarios.begin());
    std::vector<NamedCell> result;
    if (plot_.by == "model") {
      for (; place.model < static_cast<int>(data_.study.models.size()); ++place.model)
        result.push_back({data_.study.models[place.model].name, place});
    } else if (plot_.by == "scenario") {
      for (place.scenario = 0; place.scenario < static_cast<int>(scenarios.size()); ++place.scenario)
        result.push_back({scenarios[place.scenario].name, place});
    } else if (plot_.by == "sweep") {
      for (; place.sweep < data_.study.sweep.points(); ++place.sweep)
        result.push_back({point_name(place), place});
    } else {
      for (; place.choice < static_cast<int>(data_.study.cases.size()); ++place.choice)
        result.push_back({data_.study.cases[place.choice].name, place});
    }
    return result;
  }

  /// "Kp=2 Ki=1"
  std::string point_name(const RunPlace& place) const {
    const PlaceColumns columns(data_.study, false);
    const auto names = columns.header(), cells = columns.cells(place);
    const std::size_t axes = data_.study.sweep.axes.size();
    std::string name;
    for (std::size_t k = names.size() - axes; k < names.size(); ++k)
      name += fmt::format("{}{}={}", name.empty() ? "" : " ", names[k], cells[k]);
    return name;
  }

  std::int64_t first_run(const RunPlace& place) const {
    const Study& study = data_.study;
    std::int64_t cell = place.model;
    cell = cell * static_cast<std::int64_t>(study.cases.size()) + place.choice;
    cell = cell * static_cast<std::int64_t>(study.scenarios.size()) + place.scenario;
    cell = cell * study.sweep.points() + place.sweep;
    return cell * study.monte_carlo.runs;
  }

  /// A run with its log, in the group in which it was carried out: with the same steps.
  RunRecord logged(std::int64_t run) {
    const std::int64_t first = run / group_size * group_size;
    std::vector<RunRequest> group;
    for (std::int64_t k = first; k < std::min(first + group_size, data_.table.size()); ++k)
      group.push_back(data_.table.request(k));
    EvaluatorOptions options;
    options.keep_logs = true;
    return evaluator_.run(group, options)[run - first];
  }

  std::string add_signals(const RunPlace& place, const std::string& label, const std::string& csv,
                          Figure& figure) {
    const std::vector<LogColumn>& columns = data_.study.models[place.model].plan->columns;
    const auto column = [&](const std::string& name) {
      const auto found = std::ranges::find(columns, name, &LogColumn::name);
      return found == columns.end() ? 0 : static_cast<int>(found - columns.begin()) + 2;
    };
    const int x = plot_.x.empty() ? 1 : column(plot_.x);
    if (x > 1) figure.x_label = axis_label(plot_.x, columns[x - 2].unit);
    for (std::size_t k = 0; k < plot_.signals.size(); ++k) {
      const int y = column(plot_.signals[k]);
      if (x == 0 || y == 0) continue;  // a signal of another model
      figure.panels[k].label = axis_label(plot_.signals[k], columns[y - 2].unit);
      figure.panels[k].curves.push_back({csv, y, label, 1.0, x});
    }
    const RunRecord record = logged(first_run(place));
    return record.log ? to_csv(*record.log) : "time\n";
  }

  std::string add_metrics(RunPlace place, const std::string& label, const std::string& csv, Figure& figure) {
    std::vector<int> metrics;
    if (axis() < 0) metrics.push_back(metric(plot_.x));
    for (const std::string& name : plot_.signals) metrics.push_back(metric(name));
    const std::vector<Metric>& all = data_.study.models[place.model].metrics;
    figure.x_label = axis() < 0 ? axis_label(plot_.x, all[metrics[0]].unit()) : plot_.x;
    for (std::size_t k = 0; k < plot_.signals.size(); ++k) {
      const int y = metric(plot_.signals[k]);
      if (y < 0) continue;
      figure.panels[k].label = axis_label(plot_.signals[k], all[y].unit());
      figure.panels[k].curves.push_back({csv, static_cast<int>(k) + 2, label, 1.0, 1, axis() < 0});
    }
    std::vector<std::string> header{plot_.x};
    header.insert(header.end(), plot_.signals.begin(), plot_.signals.end());
    std::string text = csv_line(header);
    const std::int64_t last = plot_.by == "sweep" ? place.sweep + 1 : data_.study.sweep.points();
    for (; place.sweep < last; ++place.sweep) append_rows(place, metrics, text);
    return text;
  }

  void append_rows(const RunPlace& place, const std::vector<int>& metrics, std::string& text) const {
    const Cell cell = read_cell(data_, first_run(place));
    if (axis() >= 0) {
      const auto cells = PlaceColumns(data_.study, true).cells(place);
      std::vector<std::string> row{cells[3 + axis()]};
      for (const int each : metrics)
        row.push_back(each < 0 ? "nan" : csv_number(mean_of(values_of(cell, each))));
      text += csv_line(row);
      return;
    }
    for (const RunRecord& record : cell.records) {
      std::vector<std::string> row;
      for (const int each : metrics) row.push_back(each < 0 ? "nan" : csv_number(record.metrics[each]));
      text += csv_line(row);
    }
  }

  /// Of the runs that have a number.
  static double mean_of(const std::vector<double>& values) {
    double sum = 0.0;
    int count = 0;
    for (const double x : values) {
      if (std::isnan(x)) continue;
      sum += x;
      ++count;
    }
    return count == 0 ? std::nan("") : sum / count;
  }

  void draw(Figure& figure, ResultFiles& written) const {
    std::erase_if(figure.panels, [](const Panel& panel) { return panel.curves.empty(); });
    if (figure.panels.empty()) return;
    const fs::path script = stem_.string() + ".gp";
    write_file(script, gnuplot_script(figure, stem_.filename().string()));
    written.files.push_back(script);
    draw_figures(script, written);
  }

  const StudyData& data_;
  const PlotDefinition& plot_;
  Evaluator& evaluator_;
  fs::path stem_;
};

}  // namespace

ResultFiles write_plots(const StudyData& data, Evaluator& evaluator, const fs::path& folder) {
  ResultFiles written;
  int number = 0;
  for (const PlotDefinition& plot : data.study.plots)
    Plotter(data, plot, evaluator, folder / fmt::format("plot-{}", ++number)).write(written);
  return written;
}

}  // namespace flyball
