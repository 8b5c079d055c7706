#pragma once

#include <string>
#include <string_view>

namespace flyball {

/// The path of `name`, which `user`, another file, names relative to its own folder.
std::string path_beside(const std::string& user, std::string_view name);

/// One text for all spellings of a path, links followed.
std::string identity_of(const std::string& file);

}  // namespace flyball
