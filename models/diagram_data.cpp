#include "models/diagram_data.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "blocks/hash.h"
#include "models/language/messages.h"
#include "models/read_file.h"

namespace flyball {

const DataFiles::Content& DataFiles::open(const std::string& file) {
  const auto [found, is_new] = files_.try_emplace(file);
  Content& content = found->second;
  if (!is_new) return content;
  Diagnostics diagnostics(file);
  std::error_code none;
  const auto size = std::filesystem::file_size(file, none);
  errno = 0;
  if (!none && size > largest_csv) {
    diagnostics.error({}, message::file_too_large(largest_csv));
  } else if (const auto text = read_file_content(file, largest_csv)) {
    content.table = read_csv(*text, diagnostics);
    content.hash = fingerprint(*text);
  } else {
    diagnostics.error({}, message::unreadable(std::strerror(errno)));
  }
  content.problems = diagnostics.sorted();
  return content;
}

std::vector<DataFile> DataFiles::opened() const {
  std::vector<DataFile> all;
  for (const auto& [name, content] : files_) all.push_back({name, content.hash});
  return all;
}

}  // namespace flyball
