#include "studies/report/text_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>

#include "studies/file.h"

namespace flyball {
namespace {

constexpr std::size_t most_rows = 200;

/// The next field; moves `at` behind it.
std::string field(const std::string& text, std::size_t& at) {
  std::string value;
  bool quoted = at < text.size() && text[at] == '"';
  if (quoted) ++at;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (quoted && c == '"') {
      quoted = at + 1 < text.size() && text[at + 1] == '"';
      if (!quoted) continue;
      ++at;
    } else if (!quoted && (c == ',' || c == '\n')) {
      break;
    }
    value += c;
  }
  return value;
}

double number_in(const std::string& field) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  const bool whole = error == std::errc() && end == field.data() + field.size();
  return whole ? value : std::numeric_limits<double>::quiet_NaN();
}

/// Headings of tables of studies, in full.
std::string heading(const std::string& name) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 6> full{{{"sd", "standard deviation"},
                                                                               {"q05", "5 % quantile"},
                                                                               {"q50", "median"},
                                                                               {"q95", "95 % quantile"},
                                                                               {"low", "95 % interval from"},
                                                                               {"high", "to"}}};
  for (const auto& [brief, words] : full) {
    if (name == brief) return std::string(words);
  }
  return name;
}

std::string shown(const std::string& field) {
  if (field == "nan") return "none";
  const double value = number_in(field);
  return value == value ? fmt::format("{:.6g}", value) : field;
}

}  // namespace

int TextTable::find(std::string_view name) const {
  const auto found = std::ranges::find(header, name);
  return found == header.end() ? -1 : static_cast<int>(found - header.begin());
}

std::vector<double> TextTable::numbers(int column) const {
  std::vector<double> values;
  for (const auto& row : rows) values.push_back(number_in(row[static_cast<std::size_t>(column)]));
  return values;
}

TextTable read_text_table(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  TextTable table;
  std::vector<std::string> row;
  for (std::size_t at = 0; at < text.size(); ++at) {
    row.push_back(field(text, at));
    if (at < text.size() && text[at] == ',') continue;
    if (table.header.empty()) {
      table.header = row;
    } else {
      row.resize(table.header.size());
      table.rows.push_back(row);
    }
    row.clear();
  }
  return table;
}

HtmlTable html_table(const TextTable& table) {
  const auto tells = [&](std::size_t column) {
    const bool several = table.rows.size() > 1;
    return !several || std::ranges::any_of(
                           table.rows, [&](const auto& row) { return row[column] != table.rows[0][column]; });
  };
  HtmlTable result;
  std::vector<std::size_t> kept;
  for (std::size_t c = 0; c < table.header.size(); ++c) {
    if (!tells(c) && table.header[c] != "metric" && table.header[c] != "unit") continue;
    kept.push_back(c);
    result.header.push_back(heading(table.header[c]));
  }
  for (std::size_t r = 0; r < std::min(table.rows.size(), most_rows); ++r) {
    std::vector<std::string> row;
    for (const std::size_t c : kept) row.push_back(shown(table.rows[r][c]));
    result.rows.push_back(std::move(row));
  }
  return result;
}

}  // namespace flyball
