#include "studies/engine/study_table.h"

#include <fmt/format.h>

#include <cmath>

namespace flyball {
namespace {

std::string text_of(const std::variant<double, std::string>& value, bool exact) {
  const double* number = std::get_if<double>(&value);
  if (number == nullptr) return std::get<std::string>(value);
  return exact ? csv_number(*number) : shown_number(*number);
}

/// The value of an axis at a sweep point, where the last axis is the fastest.
const std::variant<double, std::string>& value_at(const SweepGrid& sweep, std::size_t axis,
                                                  std::int64_t point) {
  if (!sweep.zipped) {
    for (std::size_t later = axis + 1; later < sweep.axes.size(); ++later)
      point /= static_cast<std::int64_t>(sweep.axes[later].values.size());
    point %= static_cast<std::int64_t>(sweep.axes[axis].values.size());
  }
  return sweep.axes[axis].values[static_cast<std::size_t>(point)];
}

std::string quoted(const std::string& field) {
  if (field.find_first_of(",\"\n\r") == std::string::npos) return field;
  std::string result = "\"";
  for (const char c : field) result.append(c == '"' ? 2 : 1, c);
  return result + '"';
}

}  // namespace

Cell read_cell(const StudyData& data, std::int64_t first) {
  Cell cell{data.table.place(first), first, {}};
  data.store.read(first, first + data.study.monte_carlo.runs,
                  [&](const StoredRun& run) { cell.records.push_back(run.record); });
  return cell;
}

void for_each_cell(const StudyData& data, const std::function<void(const Cell&)>& each) {
  for (std::int64_t first = 0; first < data.table.size(); first += data.study.monte_carlo.runs)
    each(read_cell(data, first));
}

std::vector<double> values_of(const Cell& cell, std::size_t metric) {
  std::vector<double> values;
  for (const RunRecord& record : cell.records) values.push_back(record.metrics[metric]);
  return values;
}

PlaceColumns::PlaceColumns(const Study& study, bool all)
    : study_(study),
      model_(all || study.models.size() > 1),
      choice_(all || study.cases.size() > 1),
      scenario_(all || study.scenarios.size() > 1) {}

std::vector<std::string> PlaceColumns::header() const {
  std::vector<std::string> names;
  if (model_) names.push_back("model");
  if (choice_) names.push_back("case");
  if (scenario_) names.push_back("scenario");
  for (const Axis& axis : study_.sweep.axes) names.push_back(axis.name);
  return names;
}

std::vector<std::string> PlaceColumns::cells(const RunPlace& place) const {
  std::vector<std::string> cells;
  const bool exact = model_ && choice_ && scenario_;
  if (model_) cells.push_back(study_.models[place.model].name);
  if (choice_) cells.push_back(study_.cases[place.choice].name);
  if (scenario_) cells.push_back(study_.scenarios[place.scenario].name);
  for (std::size_t axis = 0; axis < study_.sweep.axes.size(); ++axis)
    cells.push_back(text_of(value_at(study_.sweep, axis, place.sweep), exact));
  return cells;
}

std::string csv_line(const std::vector<std::string>& fields) {
  std::string line;
  for (const std::string& field : fields) line += quoted(field) + ',';
  line.back() = '\n';
  return line;
}

std::string csv_number(double x) { return std::isnan(x) ? "nan" : fmt::format("{}", x); }

std::string shown_number(double x) { return std::isnan(x) ? "-" : fmt::format("{:.6g}", x); }

}  // namespace flyball
