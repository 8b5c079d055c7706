#include "studies/pareto/front_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "studies/figure.h"
#include "studies/file.h"

namespace flyball {
namespace {

namespace fs = std::filesystem;

std::string row(const std::vector<double>& first, const std::vector<double>& second) {
  std::string text;
  for (const std::vector<double>* numbers : {&first, &second}) {
    for (const double number : *numbers) text += fmt::format("{}{}", text.empty() ? "" : ",", number);
  }
  return text + '\n';
}

std::string objective_label(const ParetoResult& front, std::size_t objective) {
  return gnuplot_quoted(axis_label(front.objectives[objective], front.objective_units[objective]));
}

/// The first objective against another one.
std::string panel(const ParetoResult& front, const std::string& csv, std::size_t other) {
  const std::size_t first_column = front.parameters.size() + 1;
  const std::string columns = fmt::format("{}:{}", first_column, first_column + other);
  std::string script =
      fmt::format("\nset ylabel {} noenhanced\nplot {} using {} skip 1 with points pt 7 ps 0.6 notitle",
                  objective_label(front, other), gnuplot_quoted(csv), columns);
  if (front.picked >= 0) {
    script +=
        fmt::format(", \\\n     '' using {} skip 1 every ::{}::{} with points lt 2 pt 6 ps 2 title 'picked'",
                    columns, front.picked, front.picked);
  }
  return script + '\n';
}

}  // namespace

std::string front_csv(const ParetoResult& front) {
  std::string text;
  for (const auto* names : {&front.parameters, &front.objectives}) {
    for (const std::string& name : *names) text += (text.empty() ? "" : ",") + name;
  }
  text += '\n';
  for (const ParetoPoint& point : front.front) text += row(point.parameters, point.objectives);
  return text;
}

std::string front_script(const ParetoResult& front, const std::string& csv, const std::string& stem) {
  const std::size_t panels = front.objectives.size() - 1;
  std::string script = gnuplot_opening(stem, static_cast<int>(std::max<std::size_t>(600, 420 * panels)));
  script += fmt::format("set multiplot layout {},1 title {} noenhanced\nset rmargin 10\n", panels,
                        gnuplot_quoted(fmt::format("Front {}", front.name)));
  script += fmt::format("set xlabel {} noenhanced\n", objective_label(front, 0));
  for (std::size_t other = 1; other <= panels; ++other) script += panel(front, csv, other);
  return script + "\nunset multiplot\n";
}

ResultFiles write_front(const ParetoResult& front, const fs::path& csv) {
  ResultFiles written;
  write_file(csv, front_csv(front));
  written.files.push_back(csv);
  if (front.front.empty() || front.objectives.size() < 2) return written;
  const fs::path script = fs::path(csv).replace_extension("gp");
  write_file(script, front_script(front, csv.filename().string(), csv.stem().string()));
  written.files.push_back(script);
  draw_figures(script, written);
  return written;
}

}  // namespace flyball
