#pragma once

#include <filesystem>
#include <string>

#include "studies/engine/study_table.h"

namespace flyball {

/// Writes a row a cell and metric: how many runs have a number, mean, standard deviation, quantiles, and an
/// interval that holds the mean with 95 %. Throws OutputError.
void write_summary_csv(const StudyData& data, const std::filesystem::path& file);

/// The same for people, no more than forty rows: of a study without samples a row a cell with its metrics,
/// else a row a cell and metric.
std::string summary_text(const StudyData& data);

}  // namespace flyball
