#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace flyball {

/// Writes the report of a finished study from the files in its folder: study.json, and the tables and curves
/// that it lists. Gives warnings: what an extra program could not draw. Throws FileError, and MetadataError
/// for what is no study.
std::vector<std::string> write_study_report(const std::filesystem::path& folder,
                                            const std::filesystem::path& html);

}  // namespace flyball
