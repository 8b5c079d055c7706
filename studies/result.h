#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "studies/metadata.h"

namespace flyball {

/// What `write_result` left behind.
struct ResultFiles {
  std::vector<std::filesystem::path> files;  // in the order of writing; the first is the CSV file
  std::vector<std::string> warnings;
};

/// Draws a gnuplot script as SVG and as PNG beside it. Throws OutputError; a figure that cannot be drawn is a
/// warning.
void draw_figures(const std::filesystem::path& script, ResultFiles& written);

/// Writes the CSV file, and beside it, under the same name, metadata (.json), gnuplot script (.gp) and
/// figures (.svg, .png). Each file appears whole or not at all. Throws OutputError.
ResultFiles write_result(const RunResult& result, const RunInputs& inputs, const std::filesystem::path& csv);

}  // namespace flyball
