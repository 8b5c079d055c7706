#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "studies/engine/requirement_summary.h"
#include "studies/engine/run_study.h"
#include "studies/result.h"

namespace flyball {

/// What a finished study left behind, and what people are told of it.
struct StudyResults {
  ResultFiles written;
  std::string tables;      // summary, comparison, requirements
  std::string violations;  // a line for each requirement that does not hold
  std::int64_t runs = 0, failed = 0;
};

/// Writes the tables, figures and metadata of a complete study into its folder: runs.csv, summary.csv,
/// comparison.csv where there are several cases and samples, requirements.csv, bisections.csv, plots, and
/// study.json as the last. The same study gives the same bytes, however it came about. Throws OutputError.
StudyResults write_study(const Study& study, const StudyRun& run, const std::filesystem::path& folder,
                         int threads = 1);

}  // namespace flyball
