#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "models/language/diagnostics.h"

namespace flyball {

/// What was found out about a result file.
struct ResultCheck {
  std::string file;
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::vector<Diagnostic> diagnostics;  // empty: the file is what was written

  bool ok() const { return diagnostics.empty(); }
};

/// A result and the metadata beside it, for what concerns their bytes.
struct ResultText {
  std::string csv_name, csv;
  std::string json_name, json;
};

/// Compares a CSV file with the metadata beside it (the same name, .json): that the metadata is as it was
/// written, then header, row count and checksum; that each row has a finite number for each column, and that
/// time does not fall. Throws FileError when one of the two cannot be read.
ResultCheck check_result(const std::filesystem::path& csv);

/// The same for texts.
ResultCheck check_result(const ResultText& result);

}  // namespace flyball
