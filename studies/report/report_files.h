#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "studies/metadata.h"
#include "studies/report/run_report.h"

namespace flyball {

/// Writes the report of a run. Gives warnings: what an extra program could not draw. Throws OutputError.
std::vector<std::string> write_run_report(const RunResult& result, const RunInputs& inputs,
                                          const std::filesystem::path& html);

/// The same from a CSV file and the metadata beside it, and from the model if it is still what it was. Throws
/// FileError, and MetadataError for what is no result; `check_result` tells more.
std::vector<std::string> write_result_report(const std::filesystem::path& csv,
                                             const std::filesystem::path& html);

}  // namespace flyball
