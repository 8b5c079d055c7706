#pragma once

#include <filesystem>
#include <string>

#include "studies/pareto/pareto.h"
#include "studies/result.h"

namespace flyball {

/// A front as comma-separated values: a column a parameter, then a column an objective, in SI.
std::string front_csv(const ParetoResult& front);

/// A gnuplot script of the first objective against each of the others, the picked point marked.
std::string front_script(const ParetoResult& front, const std::string& csv, const std::string& stem);

/// Writes both, and the figures: NAME.csv, .gp, .svg, .png. Throws OutputError.
ResultFiles write_front(const ParetoResult& front, const std::filesystem::path& csv);

}  // namespace flyball
