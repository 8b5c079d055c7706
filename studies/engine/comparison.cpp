#include "studies/engine/comparison.h"

#include <fmt/format.h>

#include <functional>

#include "studies/file.h"
#include "studies/statistics/paired.h"
#include "studies/table.h"

namespace flyball {
namespace {

constexpr std::size_t most_rows = 40;

/// Of more pairs the first are compared: the test grows with their number, and is sure of less long before.
constexpr std::size_t most_pairs = 2000;

struct Row {
  RunPlace place;  // of the second case
  int first_case = 0;
  std::size_t metric = 0;
  PairedComparison found;
};

std::vector<double> leading(std::vector<double> values) {
  values.resize(std::min(values.size(), most_pairs));
  return values;
}

/// Two cases that meet at one place.
void compare_cells(const StudyData& data, const Cell& a, const Cell& b,
                   const std::function<void(const Row&)>& each) {
  BootstrapOptions options;
  options.seed = data.study.seed;
  for (std::size_t metric = 0; metric < data.study.metrics.size(); ++metric) {
    const auto first = leading(values_of(a, metric)), second = leading(values_of(b, metric));
    each({b.place, a.place.choice, metric, compare_paired(first, second, options)});
  }
}

/// Cell numbers count scenarios and sweep points fastest, then cases, then models.
void for_each_pair(const StudyData& data, int first_cases, const std::function<void(const Row&)>& each) {
  const Study& study = data.study;
  const auto cases = static_cast<int>(study.cases.size());
  const std::int64_t inner = static_cast<std::int64_t>(study.scenarios.size()) * study.sweep.points();
  const auto cell = [&](std::int64_t model, int choice, std::int64_t k) {
    return read_cell(data, ((model * cases + choice) * inner + k) * study.monte_carlo.runs);
  };
  for (std::int64_t model = 0; model < static_cast<std::int64_t>(study.models.size()); ++model) {
    for (std::int64_t k = 0; k < inner; ++k) {
      for (int a = 0; a < std::min(first_cases, cases - 1); ++a) {
        for (int b = a + 1; b < cases; ++b) compare_cells(data, cell(model, a, k), cell(model, b, k), each);
      }
    }
  }
}

std::vector<std::string> numbers(const Row& row, const std::function<std::string(double)>& shown) {
  return {std::to_string(row.found.pairs), shown(row.found.difference), shown(row.found.interval.lower),
          shown(row.found.interval.upper), shown(row.found.p_value)};
}

}  // namespace

bool can_compare(const Study& study) {
  return study.cases.size() > 1 && study.monte_carlo.runs > 1 && !study.metrics.empty();
}

void write_comparison_csv(const StudyData& data, const std::filesystem::path& file) {
  const PlaceColumns places(data.study, true);
  std::vector<std::string> header = places.header();
  for (const char* name : {"against", "metric", "unit", "pairs", "difference", "low", "high", "p"})
    header.emplace_back(name);
  NewFile csv(file);
  csv.write(csv_line(header));
  for_each_pair(data, static_cast<int>(data.study.cases.size()), [&](const Row& row) {
    std::vector<std::string> fields = places.cells(row.place);
    fields.push_back(data.study.cases[row.first_case].name);
    fields.push_back(data.study.metrics[row.metric].first);
    fields.push_back(data.study.models[row.place.model].metrics[row.metric].unit());
    for (std::string& number : numbers(row, csv_number)) fields.push_back(std::move(number));
    csv.write(csv_line(fields));
  });
  csv.commit();
}

std::string comparison_text(const StudyData& data) {
  const PlaceColumns places(data.study, false);
  std::vector<std::string> header = places.header();
  for (const char* name : {"against", "metric", "pairs", "difference", "low", "high", "by chance"})
    header.emplace_back(name);
  Table table(header);
  table.group(static_cast<int>(places.header().size()) + 4, 2, "95 % interval");
  std::size_t rows = 0;
  for_each_pair(data, 1, [&](const Row& row) {
    if (++rows > most_rows) return;
    std::vector<std::string> cells = places.cells(row.place);
    cells.push_back(data.study.cases[row.first_case].name);
    cells.push_back(data.study.metrics[row.metric].first);
    for (std::string& number : numbers(row, shown_number)) cells.push_back(std::move(number));
    table.row(cells);
  });
  const std::string rest =
      rows <= most_rows ? "" : fmt::format("… and {} more rows: comparison.csv\n", rows - most_rows);
  return "Differences between runs of one sample\n" + table.text() + rest;
}

}  // namespace flyball
