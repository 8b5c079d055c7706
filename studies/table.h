#pragma once

#include <string>
#include <vector>

namespace flyball {

/// Text in columns, for people. Cells that are numbers stand with their decimal points below each other,
/// others begin at the left edge of their column.
class Table {
 public:
  explicit Table(std::vector<std::string> header) : header_(std::move(header)) {}

  /// A heading above `count` columns from `first` on.
  void group(int first, int count, std::string heading) {
    groups_.push_back({first, count, std::move(heading)});
  }
  /// Missing cells are empty.
  void row(std::vector<std::string> cells);

  /// Lines that end in LF, without blanks at their ends.
  std::string text() const;

 private:
  struct Group {
    int first, count;
    std::string heading;
  };
  struct Column {
    int whole = 0;     // characters before the decimal point of its numbers
    int fraction = 0;  // and from it on
    int width = 0;
    bool numeric = false;
  };

  std::vector<Column> measure() const;
  std::string group_line(const std::vector<Column>& columns) const;

  std::vector<std::string> header_;
  std::vector<Group> groups_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace flyball
