#pragma once

#include <filesystem>
#include <string>

#include "studies/drawing.h"

namespace flyball {

/// Runs gnuplot on a script in the script's folder, without a shell, and puts the figure beside it whole or
/// not at all. `format` is "svg" or "png". A figure is an extra: that gnuplot is missing or fails is a
/// warning; a figure that cannot be written is not: throws OutputError.
Drawing draw(const std::filesystem::path& script, const std::filesystem::path& figure,
             const std::string& format);

}  // namespace flyball
