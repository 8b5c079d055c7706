#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "models/diagram.h"
#include "models/language/csv.h"

namespace flyball {

/// The files of values that the blocks of one model read, each read once.
class DataFiles {
 public:
  struct Content {
    std::optional<CsvTable> table;     // nothing when the file cannot be read
    std::vector<Diagnostic> problems;  // with it
    std::string hash;
  };

  const Content& open(const std::string& file);
  /// Those that were opened, by name.
  std::vector<DataFile> opened() const;

 private:
  std::map<std::string, Content, std::less<>> files_;
};

}  // namespace flyball
