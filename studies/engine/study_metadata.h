#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "studies/engine/requirement_summary.h"

namespace flyball {

/// All about a study that its tables do not tell, as JSON text: files and models with hashes, cases with what
/// was found for them, metrics and requirements with their units, versions, and the files beside it with
/// their checksums. Equal studies give equal bytes.
std::string study_json(const StudyData& data, const std::vector<Choice>& cases,
                       const std::vector<RequirementSummary>& requirements,
                       const std::vector<std::filesystem::path>& files);

/// How far a study is, for machines.
struct StudyRun;
std::string status_json(const StudyRun& run);

}  // namespace flyball
