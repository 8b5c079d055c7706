#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace flyball {

/// Runs a program of the search path in a folder, without a shell and without streams, and waits for its end.
/// Returns its exit status, 128 + the signal that ended it, or -1 when there is no such program.
int run_process(std::vector<std::string> arguments, const std::filesystem::path& folder);

}  // namespace flyball
