#include "studies/engine/summary.h"

#include <fmt/format.h>

#include "studies/engine/interval_of_mean.h"
#include "studies/file.h"
#include "studies/statistics/sample.h"
#include "studies/table.h"

namespace flyball {
namespace {

constexpr int most_rows = 40;

struct Summary {
  std::size_t runs = 0;  // with a number
  double mean, deviation, low, median, high;
  Interval interval;
};

Summary summarise(const std::vector<double>& numbers, std::uint64_t seed) {
  const Sample sample(numbers);
  const auto& x = sample.values;
  return {x.size(),         mean(x),           standard_deviation(x),    quantile(x, 0.05),
          quantile(x, 0.5), quantile(x, 0.95), interval_of_mean(x, seed)};
}

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() || unit == "1" ? name : fmt::format("{} [{}]", name, unit);
}

const std::string& unit_of(const StudyData& data, int model, std::size_t metric) {
  return data.study.models[model].metrics[metric].unit();
}

std::string rest_of(std::int64_t rows) {
  if (rows <= most_rows) return {};
  return fmt::format("… and {} more rows: summary.csv\n", rows - most_rows);
}

/// Without samples: a column a metric.
std::string values_text(const StudyData& data) {
  const PlaceColumns places(data.study, false);
  std::vector<std::string> header = places.header();
  for (std::size_t k = 0; k < data.study.metrics.size(); ++k)
    header.push_back(with_unit(data.study.metrics[k].first, unit_of(data, 0, k)));
  Table table(header);
  const std::int64_t rows = data.table.size();
  for (std::int64_t run = 0; run < std::min<std::int64_t>(rows, most_rows); ++run) {
    const Cell cell = read_cell(data, run);
    std::vector<std::string> row = places.cells(cell.place);
    for (const double metric : cell.records.at(0).metrics) row.push_back(shown_number(metric));
    table.row(row);
  }
  return table.text() + rest_of(rows);
}

std::string samples_text(const StudyData& data) {
  const PlaceColumns places(data.study, false);
  std::vector<std::string> header = places.header();
  for (const char* name : {"metric", "runs", "mean", "sd", "5 %", "50 %", "95 %", "low", "high"})
    header.emplace_back(name);
  Table table(header);
  const int places_before = static_cast<int>(places.header().size());
  table.group(places_before + 4, 3, "quantiles");
  table.group(places_before + 7, 2, "95 % interval of the mean");
  const auto metrics = static_cast<std::int64_t>(data.study.metrics.size());
  const std::int64_t rows = data.table.size() / data.study.monte_carlo.runs * metrics;
  for (std::int64_t k = 0; k < std::min<std::int64_t>(rows, most_rows) / metrics; ++k) {
    const Cell cell = read_cell(data, k * data.study.monte_carlo.runs);
    for (std::size_t metric = 0; metric < data.study.metrics.size(); ++metric) {
      const Summary s = summarise(values_of(cell, metric), data.study.seed);
      std::vector<std::string> row = places.cells(cell.place);
      row.push_back(with_unit(data.study.metrics[metric].first, unit_of(data, cell.place.model, metric)));
      row.push_back(std::to_string(s.runs));
      for (const double x :
           {s.mean, s.deviation, s.low, s.median, s.high, s.interval.lower, s.interval.upper})
        row.push_back(shown_number(x));
      table.row(row);
    }
  }
  return table.text() + rest_of(rows);
}

}  // namespace

void write_summary_csv(const StudyData& data, const std::filesystem::path& file) {
  const PlaceColumns places(data.study, true);
  std::vector<std::string> header = places.header();
  for (const char* name : {"metric", "unit", "runs", "mean", "sd", "q05", "q50", "q95", "low", "high"})
    header.emplace_back(name);
  NewFile csv(file);
  csv.write(csv_line(header));
  for_each_cell(data, [&](const Cell& cell) {
    std::string text;
    for (std::size_t metric = 0; metric < data.study.metrics.size(); ++metric) {
      const Summary s = summarise(values_of(cell, metric), data.study.seed);
      std::vector<std::string> row = places.cells(cell.place);
      row.push_back(data.study.metrics[metric].first);
      row.push_back(unit_of(data, cell.place.model, metric));
      row.push_back(std::to_string(s.runs));
      for (const double x :
           {s.mean, s.deviation, s.low, s.median, s.high, s.interval.lower, s.interval.upper})
        row.push_back(csv_number(x));
      text += csv_line(row);
    }
    csv.write(text);
  });
  csv.commit();
}

std::string summary_text(const StudyData& data) {
  return data.study.monte_carlo.runs == 1 ? values_text(data) : samples_text(data);
}

}  // namespace flyball
