#include "models/language/csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "models/language/messages.h"
#include "models/language/source_text.h"
#include "models/language/units.h"

namespace flyball {
namespace {

/// A field without its quotes and the spaces around it, and where it begins.
struct Field {
  std::string_view text;
  std::string unquoted;  // of a field with doubled quotes, what `text` views
  std::size_t offset = 0;
};

class CsvReader {
 public:
  CsvReader(std::string_view text, Diagnostics& diagnostics) : text_(text), diagnostics_(diagnostics) {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = line_start_ = 3;
  }

  std::optional<CsvTable> read() {
    if (text_.size() > largest_csv) return error(at_, message::file_too_large(largest_csv)), std::nullopt;
    if (at_end()) return error(at_, message::csv_empty()), std::nullopt;
    read_header();
    if (errors_ > 0) return std::nullopt;
    while (errors_ < most_csv_errors && !at_end()) read_row();
    if (errors_ == 0 && table_.numbers.empty()) error(text_.size(), message::csv_without_rows());
    return errors_ > 0 ? std::nullopt : std::optional(std::move(table_));
  }

 private:
  bool at_end() const { return at_ >= text_.size(); }
  bool at_line_end() const { return at_end() || text_[at_] == '\n' || text_.substr(at_, 2) == "\r\n"; }

  void end_line() {
    if (!at_end()) at_ += text_[at_] == '\r' ? 2 : 1;
    line_start_ = at_;
    ++line_;
  }
  void skip_line() {
    at_ = std::min(text_.find('\n', at_), text_.size());
    end_line();
  }

  void read_header() {
    for (bool more = true; more;) {
      Field field;
      if (!read_field(field)) return skip_line();
      declare(field);
      more = comma();
    }
    end_line();
  }

  void read_row() {
    if (at_line_end()) return wrong_width(at_, 0);
    int column = 0;
    for (bool more = true; more; ++column) {
      Field field;
      if (!read_field(field)) return skip_line();
      if (column == table_.width()) return wrong_width(field.offset, column);
      table_.numbers.push_back(number(field));
      more = comma();
    }
    if (column < table_.width()) return wrong_width(at_, column);
    end_line();
  }

  void wrong_width(std::size_t offset, int column) {
    const auto rest = text_.substr(offset, text_.find('\n', offset) - offset);
    const auto found = column < table_.width() ? column : column + 1 + std::ranges::count(rest, ',');
    error(offset, message::csv_row_width(table_.width(), static_cast<int>(found)));
    skip_line();
  }

  bool comma() {
    if (at_end() || text_[at_] != ',') return false;
    ++at_;
    return true;
  }

  void skip_spaces() {
    while (!at_end() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }

  /// False after an error.
  bool read_field(Field& field) {
    skip_spaces();
    field.offset = at_;
    if (!at_end() && text_[at_] == '"') return read_quoted(field);
    const std::size_t begin = at_;
    while (!at_line_end() && text_[at_] != ',') {
      if (text_[at_] == '"') return error(at_, message::csv_quote_inside()), false;
      if (is_control(text_[at_])) return error(at_, message::control_character(text_[at_])), false;
      ++at_;
    }
    std::size_t end = at_;
    while (end > begin && (text_[end - 1] == ' ' || text_[end - 1] == '\t')) --end;
    field.text = text_.substr(begin, end - begin);
    return true;
  }

  bool read_quoted(Field& field) {
    const std::size_t quote = at_++;
    for (;;) {
      if (at_line_end()) return error(quote, message::csv_quote_open()), false;
      if (is_control(text_[at_])) return error(at_, message::control_character(text_[at_])), false;
      if (text_[at_] == '"' && text_.substr(at_, 2) != "\"\"") break;
      field.unquoted += text_[at_];
      at_ += text_[at_] == '"' ? 2 : 1;
    }
    ++at_;
    skip_spaces();
    field.text = field.unquoted;
    if (at_line_end() || text_[at_] == ',') return true;
    return error(at_, message::csv_after_quote()), false;
  }

  static bool is_control(char c) { return static_cast<unsigned char>(c) < ' ' && c != '\t'; }

  void declare(const Field& field) {
    CsvTable::Column column;
    const std::size_t bracket = field.text.ends_with(']') ? field.text.rfind('[') : std::string_view::npos;
    std::string_view name = field.text.substr(0, bracket);
    if (bracket != std::string_view::npos) {
      column.unit = field.text.substr(bracket + 1, field.text.size() - bracket - 2);
      try {
        parse_unit(column.unit);
      } catch (const TextError& wrong) {
        error(field.offset + bracket + 1 + wrong.offset(), wrong.what());
      }
    }
    while (name.ends_with(' ') || name.ends_with('\t')) name.remove_suffix(1);
    if (name.empty())
      error(field.offset, message::csv_column_without_name());
    else if (table_.find(name) >= 0)
      error(field.offset, message::csv_column_twice(name));
    column.name = name;
    table_.columns.push_back(std::move(column));
  }

  double number(const Field& field) {
    double value = 0.0;
    const char* const end = field.text.data() + field.text.size();
    const auto [stop, problem] = std::from_chars(field.text.data(), end, value);
    if (problem == std::errc() && stop == end && std::isfinite(value)) return value;
    const bool is_number = stop == end && problem != std::errc::invalid_argument;
    error(field.offset,
          is_number ? message::csv_not_finite(field.text) : message::csv_not_a_number(field.text));
    return 0.0;
  }

  void error(std::size_t offset, std::string message) {
    ++errors_;
    const auto is_start = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; };
    const auto before = text_.substr(line_start_, offset - line_start_);
    diagnostics_.error({line_, static_cast<int>(std::ranges::count_if(before, is_start)) + 1},
                       std::move(message));
  }

  std::string_view text_;
  Diagnostics& diagnostics_;
  CsvTable table_;
  std::size_t at_ = 0, line_start_ = 0;
  int line_ = 1, errors_ = 0;
};

/// The factor and offset to SI of a column; nothing when its unit does not parse.
Unit unit_of(const CsvTable::Column& column) {
  return column.unit.empty() ? Unit{} : parse_unit(column.unit);
}

std::vector<std::string> names_of(const CsvTable& table) {
  std::vector<std::string> names;
  for (const CsvTable::Column& column : table.columns) names.push_back(column.name);
  return names;
}

/// The column that is meant; 0, which is time, after an error.
int column_named(const CsvTable& table, std::string_view name, Diagnostics& diagnostics) {
  if (table.width() < 2) {
    diagnostics.error({1, 1}, message::csv_time_alone());
    return 0;
  }
  if (name.empty() && table.width() == 2) return 1;
  const int found = table.find(name);
  if (name.empty() || found < 0)
    diagnostics.error({1, 1}, message::csv_unknown_column(name, names_of(table)));
  return std::max(found, 0);
}

}  // namespace

int CsvTable::find(std::string_view name) const {
  const auto found = std::ranges::find(columns, name, &Column::name);
  return found == columns.end() ? -1 : static_cast<int>(found - columns.begin());
}

std::optional<CsvTable> read_csv(std::string_view text, Diagnostics& diagnostics) {
  if (const auto bad = find_invalid_utf8(text)) {
    const auto line = static_cast<int>(std::ranges::count(text.substr(0, *bad), '\n')) + 1;
    diagnostics.error({line, 1}, message::not_utf8(static_cast<unsigned char>(text[*bad])));
    return std::nullopt;
  }
  return CsvReader(text, diagnostics).read();
}

std::optional<std::vector<std::vector<double>>> read_columns(const CsvTable& table,
                                                             const std::vector<std::string>& names,
                                                             const std::string& unit,
                                                             Diagnostics& diagnostics) {
  const int errors = diagnostics.errors();
  std::vector<std::vector<double>> rows(static_cast<std::size_t>(table.rows()));
  for (const std::string& name : names) {
    const int column = table.find(name);
    if (column < 0) {
      diagnostics.error({1, 1}, message::csv_unknown_column(name, names_of(table)));
      continue;
    }
    const CsvTable::Column& header = table.columns[static_cast<std::size_t>(column)];
    const Unit in = header.unit.empty() ? parse_unit(unit) : parse_unit(header.unit);
    if (in.dimension != parse_unit(unit).dimension)
      diagnostics.error({1, 1}, message::wrong_dimension(unit, parse_unit(unit).dimension, in.dimension));
    for (int row = 0; row < table.rows(); ++row)
      rows[static_cast<std::size_t>(row)].push_back(table.at(row, column) * in.factor + in.offset);
  }
  return diagnostics.errors() == errors ? std::optional(std::move(rows)) : std::nullopt;
}

std::shared_ptr<const TimeSeries> read_time_series(const CsvTable& table, std::string_view name,
                                                   Diagnostics& diagnostics) {
  const int errors = diagnostics.errors();
  const int column = column_named(table, name, diagnostics);
  const Unit time = unit_of(table.columns[0]),
             unit = unit_of(table.columns[static_cast<std::size_t>(column)]);
  const std::string& time_unit = table.columns[0].unit;
  if (!time_unit.empty() && time.dimension != parse_unit("s").dimension) {
    diagnostics.error({1, 1}, message::wrong_dimension("s", parse_unit("s").dimension, time.dimension));
  }
  auto series = std::make_shared<TimeSeries>();
  if (!table.columns[static_cast<std::size_t>(column)].unit.empty()) series->unit = to_string(unit.dimension);
  for (int row = 0; row < table.rows(); ++row) {
    const double t = table.at(row, 0) * time.factor + time.offset;
    if (row > 0 && t < series->times.back()) {
      diagnostics.error({CsvTable::line_of(row), 1}, message::csv_time_falls(series->times.back(), t));
      break;
    }
    series->times.push_back(t);
    series->values.push_back(table.at(row, column) * unit.factor + unit.offset);
  }
  return diagnostics.errors() == errors ? series : nullptr;
}

}  // namespace flyball
