#pragma once

#include <string>
#include <string_view>

namespace flyball {

/// A TOML text, which `parse_toml` has accepted, in the one layout of model files: every comment, value and
/// line break between entries of a list stays; blanks, alignment and blank lines are put in order. Formatting
/// twice changes nothing more.
std::string format_toml(std::string_view text);

}  // namespace flyball
