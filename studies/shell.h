#pragma once

#include <string>

namespace flyball {

/// For a shell: in single quotes where it must be.
std::string shell_quoted(const std::string& text);

}  // namespace flyball
