#include "studies/table.h"

#include <algorithm>
#include <charconv>
#include <string_view>

namespace flyball {
namespace {

constexpr int gap = 2;

/// Characters, not bytes: continuation bytes of UTF-8 take no room.
int length(std::string_view text) {
  return static_cast<int>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

bool is_number(std::string_view cell) {
  double value = 0.0;
  if (cell.starts_with('+')) cell.remove_prefix(1);
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error != std::errc::invalid_argument && end == cell.data() + cell.size();
}

/// Characters before the decimal point, or before the exponent where there is no point.
int whole_part(std::string_view number) {
  return static_cast<int>(std::min(number.find_first_of(".eE"), number.size()));
}

std::string blanks(int n) { return std::string(static_cast<std::size_t>(std::max(n, 0)), ' '); }

void end_line(std::string& text) {
  text.erase(text.find_last_not_of(' ') + 1);
  text += '\n';
}

}  // namespace

void Table::row(std::vector<std::string> cells) {
  cells.resize(header_.size());
  rows_.push_back(std::move(cells));
}

std::vector<Table::Column> Table::measure() const {
  std::vector<Column> columns(header_.size());
  for (std::size_t c = 0; c < columns.size(); ++c) {
    Column& column = columns[c];
    for (const auto& row : rows_) {
      if (is_number(row[c])) {
        column.numeric = true;
        column.whole = std::max(column.whole, whole_part(row[c]));
        column.fraction = std::max(column.fraction, length(row[c]) - whole_part(row[c]));
      }
      column.width = std::max(column.width, length(row[c]));
    }
    column.width = std::max({column.width, length(header_[c]), column.whole + column.fraction});
  }
  // A heading that is wider than its columns widens the last of them.
  for (const Group& group : groups_) {
    int width = -gap;
    for (int c = group.first; c < group.first + group.count; ++c) width += columns[c].width + gap;
    columns[group.first + group.count - 1].width += std::max(0, length(group.heading) - width);
  }
  return columns;
}

std::string Table::group_line(const std::vector<Column>& columns) const {
  std::string line;
  for (int c = 0; c < static_cast<int>(columns.size()); ++c) {
    const auto group = std::ranges::find(groups_, c, &Group::first);
    const int start = length(line);
    if (group == groups_.end()) {
      line += blanks(columns[c].width + gap);
      continue;
    }
    int width = 0;
    for (int k = c; k < c + group->count; ++k) width += columns[k].width + gap;
    line += group->heading;
    line += blanks(start + width - length(line));
    c += group->count - 1;
  }
  return line;
}

std::string Table::text() const {
  const std::vector<Column> columns = measure();
  std::string text;
  if (!groups_.empty()) {
    text += group_line(columns);
    end_line(text);
  }
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const std::string room = blanks(columns[c].width - length(header_[c]));
    text += columns[c].numeric ? room + header_[c] : header_[c] + room;
    text += blanks(gap);
  }
  end_line(text);
  for (const auto& row : rows_) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const Column& column = columns[c];
      const int before = is_number(row[c]) ? column.width - column.fraction - whole_part(row[c]) : 0;
      text += blanks(before) + row[c] + blanks(column.width - before - length(row[c]) + gap);
    }
    end_line(text);
  }
  return text;
}

}  // namespace flyball
