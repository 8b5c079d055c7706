#pragma once

#include <filesystem>

#include "studies/engine/study_table.h"

namespace flyball {

/// Writes a row a run, in order: its number, where it stands in the study, sample and seed, the values of
/// [monte_carlo], how it ended, its metrics in SI, and of each requirement whether it passed and by how much.
/// It takes no more memory for more runs. Throws OutputError.
void write_runs_csv(const StudyData& data, const std::filesystem::path& file);

}  // namespace flyball
