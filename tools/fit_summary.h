#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "studies/fit/fit_files.h"

namespace flyball {

/// What a fit found, in a few lines, and how to use it.
std::string fit_summary(const FitResult& result, const FitInputs& inputs,
                        const std::vector<std::filesystem::path>& files);

}  // namespace flyball
