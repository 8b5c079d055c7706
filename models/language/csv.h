#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "blocks/time_series.h"
#include "models/language/diagnostics.h"

namespace flyball {

/// A table of numbers that was read from comma-separated values.
struct CsvTable {
  struct Column {
    std::string name;  // without the unit
    std::string unit;  // as written behind the name, "v [m/s]"; empty without
  };

  std::vector<Column> columns;
  std::vector<double> numbers;  // row by row, in the units of the columns

  int width() const { return static_cast<int>(columns.size()); }
  int rows() const { return width() == 0 ? 0 : static_cast<int>(numbers.size()) / width(); }
  double at(int row, int column) const {
    return numbers[static_cast<std::size_t>(row) * columns.size() + static_cast<std::size_t>(column)];
  }
  /// Where a row stands in the file: the header is line 1.
  static int line_of(int row) { return row + 2; }
  int find(std::string_view name) const;  ///< -1 when there is none
};

/// A file larger than this is refused.
inline constexpr std::size_t largest_csv = 1'000'000'000;

/// Reads a header of distinct names, then rows of as many finite numbers (RFC 4180 with commas; lines end in
/// LF or CRLF; a byte-order mark, quoted fields, and spaces around fields are taken). Reports what is wrong,
/// but no more than `most_csv_errors`; then the result is empty.
std::optional<CsvTable> read_csv(std::string_view text, Diagnostics& diagnostics);
inline constexpr int most_csv_errors = 10;

/// The columns of these names, in their order and in SI, row by row; a column without a unit is in `unit`.
/// Reports what is wrong; then the result is empty.
std::optional<std::vector<std::vector<double>>> read_columns(const CsvTable& table,
                                                             const std::vector<std::string>& names,
                                                             const std::string& unit,
                                                             Diagnostics& diagnostics);

/// A column over the first one, which is time: both in SI, by the units in the header (s, and none, without).
/// `name` may be empty when there are two columns. Reports what is wrong; then the result is empty. Times
/// must not fall; two rows of one time are the sides of a jump.
std::shared_ptr<const TimeSeries> read_time_series(const CsvTable& table, std::string_view name,
                                                   Diagnostics& diagnostics);

}  // namespace flyball
