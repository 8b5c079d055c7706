#include "studies/result_check.h"

#include <fmt/format.h>

#include <algorithm>

#include "blocks/hash.h"
#include "models/language/csv.h"
#include "models/language/messages.h"
#include "studies/file.h"
#include "studies/metadata.h"

namespace flyball {
namespace {

void check_header(const CsvTable& table, const CsvMetadata& metadata, Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (const CsvTable::Column& column : table.columns) names.push_back(column.name);
  if (names == metadata.columns) return;
  diagnostics.error({1, 1}, fmt::format("expected the columns {}, found {}", fmt::join(metadata.columns, ","),
                                        fmt::join(names, ",")));
}

void check_times(const CsvTable& table, Diagnostics& diagnostics) {
  for (int row = 1; row < table.rows(); ++row) {
    const double before = table.at(row - 1, 0), after = table.at(row, 0);
    if (after >= before) continue;
    diagnostics.error({CsvTable::line_of(row), 1}, message::csv_time_falls(before, after));
    return;
  }
}

void check_rows(std::size_t rows, std::size_t expected, Diagnostics& diagnostics) {
  if (rows == expected) return;
  const Position at{static_cast<int>(std::min(rows, expected)) + 2, 1};
  diagnostics.error(at, rows < expected ? fmt::format("the file ends after {} of {} rows", rows, expected)
                                        : fmt::format("expected the end of the file after {} rows, found {}",
                                                      expected, rows));
}

void check_table(const ResultText& result, const CsvMetadata& metadata, Diagnostics& diagnostics) {
  // A run that failed at its start has no rows, which are not worth an error here.
  if (metadata.rows == 0 || result.csv.size() > largest_csv) return;
  const auto table = read_csv(result.csv, diagnostics);
  if (!table) return;
  check_header(*table, metadata, diagnostics);
  check_times(*table, diagnostics);
}

}  // namespace

ResultCheck check_result(const ResultText& result) {
  ResultCheck check{result.csv_name, 0, 0, {}};
  CsvMetadata metadata;
  try {
    metadata = read_csv_metadata(result.json);
  } catch (const MetadataError& error) {
    check.diagnostics.push_back({Diagnostic::Severity::error, result.json_name, {}, error.what()});
    return check;
  }
  const auto lines = static_cast<std::size_t>(std::ranges::count(result.csv, '\n'));
  check.rows = lines - std::min<std::size_t>(lines, 1);
  check.columns = metadata.columns.size();
  Diagnostics diagnostics(result.csv_name);
  check_table(result, metadata, diagnostics);
  check_rows(check.rows, metadata.rows, diagnostics);
  const std::string checksum = fingerprint(result.csv);
  if (checksum != metadata.checksum) {
    diagnostics.error({}, fmt::format("changed or truncated: expected the checksum {}, found {}",
                                      metadata.checksum, checksum));
  }
  check.diagnostics = diagnostics.sorted();
  return check;
}

ResultCheck check_result(const std::filesystem::path& csv) {
  const auto json = std::filesystem::path(csv).replace_extension("json");
  return check_result(ResultText{csv.string(), read_file(csv), json.string(), read_file(json)});
}

}  // namespace flyball
