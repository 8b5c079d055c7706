#pragma once

#include <filesystem>
#include <string>

#include "studies/fit/fit.h"
#include "studies/result.h"

namespace flyball {

/// Where a fit came from, for its files.
struct FitInputs {
  std::string model_file;
  std::string title;  // of the figure
  std::string stem;   // of the files
};

/// Writes into `folder`, which exists: STEM.json, all of the result; STEM.toml, [cases] of a study with what
/// was found; and for each experiment STEM.csv (STEM_NAME.csv where there are several): the data, and the
/// model before and after, with a gnuplot script and figures beside it. Each file appears whole or not at
/// all. Throws OutputError.
ResultFiles write_fit(const FitResult& result, const FitInputs& inputs, const std::filesystem::path& folder);

/// The result as JSON text; what is not a number is null.
std::string fit_json(const FitResult& result, const FitInputs& inputs);

/// [cases] with the settings of the result, in SI, numbers in their shortest exact form, to be copied into a
/// study file.
std::string fit_cases(const FitResult& result);

/// Time, then for each signal its data, and the model before and after, in SI:
/// "time,y_data,y_before,y_after".
std::string fit_csv(const FittedExperiment& experiment);

}  // namespace flyball
