#include "studies/engine/runs_csv.h"

#include <fmt/format.h>

#include <limits>

#include "studies/file.h"

namespace flyball {
namespace {

std::vector<std::string> header(const Study& study, const PlaceColumns& places) {
  std::vector<std::string> names{"run"};
  const auto add = [&](const std::string& name) { names.push_back(name); };
  for (const std::string& name : places.header()) add(name);
  add("sample");
  add("seed");
  for (const auto& [name, spread] : study.monte_carlo.spread) add(name);
  add("status");
  for (const auto& [name, text] : study.metrics) add(name);
  for (const auto& [name, text] : study.requirements) {
    add("passed " + name);
    add("margin " + name);
  }
  add("end");
  add("reason");
  return names;
}

/// What the run was given; later settings count more.
std::string given(const RunRequest& request, const std::string& name) {
  for (auto setting = request.settings.rbegin(); setting != request.settings.rend(); ++setting) {
    if (setting->name != name) continue;
    const double* number = std::get_if<double>(&setting->value);
    return number != nullptr ? csv_number(*number) : std::get<std::string>(setting->value);
  }
  return {};
}

std::vector<std::string> row(const StudyData& data, const PlaceColumns& places, const StoredRun& run) {
  const RunPlace place = data.table.place(run.run);
  const RunRequest request = data.table.request(run.run);
  std::vector<std::string> fields{std::to_string(run.run)};
  const auto add = [&](std::string field) { fields.push_back(std::move(field)); };
  for (std::string& cell : places.cells(place)) add(std::move(cell));
  add(std::to_string(place.sample));
  add(std::to_string(request.seed));
  for (const auto& [name, spread] : data.study.monte_carlo.spread) add(given(request, name));
  add(to_string(run.record.status));
  for (const double metric : run.record.metrics) add(csv_number(metric));
  for (const Verdict& verdict : run.record.verdicts) {
    add(verdict.passed ? "1" : "0");
    add(csv_number(verdict.margin));
  }
  add(csv_number(run.record.end));
  add(run.record.reason);
  return fields;
}

}  // namespace

void write_runs_csv(const StudyData& data, const std::filesystem::path& file) {
  constexpr std::size_t at_once = 1 << 16;
  const PlaceColumns places(data.study, true);
  NewFile csv(file);
  std::string text = csv_line(header(data.study, places));
  data.store.read(0, std::numeric_limits<std::int64_t>::max(), [&](const StoredRun& run) {
    text += csv_line(row(data, places, run));
    if (text.size() < at_once) return;
    csv.write(text);
    text.clear();
  });
  csv.write(text);
  csv.commit();
}

}  // namespace flyball
