#include "studies/metrics/data_table.h"

#include <stdexcept>

#include "models/diagram_data.h"
#include "models/language/messages.h"
#include "models/language/units.h"

namespace flyball {
namespace {

/// The first of several problems: it stands on one line of a message about something else.
[[noreturn]] void refuse(const std::vector<Diagnostic>& problems) {
  throw std::runtime_error(to_string(problems.front()));
}

}  // namespace

DataTable::DataTable(const std::filesystem::path& file) : file_(file.string()) {
  DataFiles files;
  const DataFiles::Content& content = files.open(file_);
  if (!content.problems.empty()) refuse(content.problems);
  table_ = *content.table;
}

DataColumn DataTable::column(std::string_view name) const {
  const int found = table_.find(name);
  if (found < 0) {
    std::vector<std::string> known;
    for (const CsvTable::Column& column : table_.columns) known.push_back(column.name);
    refuse({{Diagnostic::Severity::error, file_, {1, 1}, message::csv_unknown_column(name, known)}});
  }
  const std::string& written = table_.columns[static_cast<std::size_t>(found)].unit;
  const Unit unit = written.empty() ? Unit{} : parse_unit(written);
  DataColumn result;
  if (!written.empty()) result.unit = to_string(unit.dimension);
  for (int row = 0; row < table_.rows(); ++row)
    result.values.push_back(table_.at(row, found) * unit.factor + unit.offset);
  return result;
}

TimeSeries DataTable::series(std::string_view name) const {
  Diagnostics diagnostics(file_);
  const auto series = read_time_series(table_, name, diagnostics);
  if (series == nullptr) refuse(diagnostics.sorted());
  return *series;
}

}  // namespace flyball
