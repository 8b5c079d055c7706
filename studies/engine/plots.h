#pragma once

#include <filesystem>

#include "studies/engine/study_table.h"
#include "studies/result.h"

namespace flyball {

/// Draws each [[plot]] of a study into a folder: plot-1.gp, .svg and .png, and a CSV file a curve. Curves
/// over time are of the first sample, curves of metrics over an axis of [sweep] are means over the samples,
/// those over a metric have a point a run. Throws OutputError.
ResultFiles write_plots(const StudyData& data, Evaluator& evaluator, const std::filesystem::path& folder);

}  // namespace flyball
