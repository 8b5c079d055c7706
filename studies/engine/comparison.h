#pragma once

#include <filesystem>
#include <string>

#include "studies/engine/study_table.h"

namespace flyball {

/// Whether cases can be compared sample by sample: there are several of both.
bool can_compare(const Study& study);

/// Writes a row for each two cases and each metric, at each model, scenario and sweep point: the mean of the
/// differences between runs of one sample, its 95 % interval, and how often chance alone would make one as
/// large. Throws OutputError.
void write_comparison_csv(const StudyData& data, const std::filesystem::path& file);

/// The same for people, each case against the first; no more than forty rows.
std::string comparison_text(const StudyData& data);

}  // namespace flyball
