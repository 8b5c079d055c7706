#pragma once

#include <optional>
#include <string>

namespace flyball {

/// All bytes of a file. Nothing when it cannot be read; errno then says why.
std::optional<std::string> read_file_content(const std::string& file);

}  // namespace flyball
