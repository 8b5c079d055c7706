#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "models/language/csv.h"

namespace flyball {

/// A column of a file, in SI.
struct DataColumn {
  std::string unit = "any";
  std::vector<double> values;
};

/// A CSV file that a metric or a requirement compares with. All that is wrong with it is thrown as
/// std::runtime_error, `file:line:column: error: …`, on one line.
class DataTable {
 public:
  explicit DataTable(const std::filesystem::path& file);

  bool has(std::string_view name) const { return table_.find(name) >= 0; }
  int width() const { return table_.width(); }
  const std::string& name(int column) const { return table_.columns[static_cast<std::size_t>(column)].name; }
  DataColumn column(std::string_view name) const;
  /// A column over the first one, which is time. An empty name: the only other column.
  TimeSeries series(std::string_view name) const;

 private:
  std::string file_;
  CsvTable table_;
};

}  // namespace flyball
