#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "studies/report/html_page.h"

namespace flyball {

/// A CSV file as it is read by people: fields are texts.
struct TextTable {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;  // each as long as the header

  /// -1 when there is none.
  int find(std::string_view name) const;
  /// A column of numbers; NaN for what is none.
  std::vector<double> numbers(int column) const;
};

/// Comma-separated fields, in double quotes where they need them (RFC 4180). Throws FileError.
TextTable read_text_table(const std::filesystem::path& file);

/// For a page: numbers with six digits, no column that says the same in all of several rows, and no more rows
/// than people read.
HtmlTable html_table(const TextTable& table);

}  // namespace flyball
