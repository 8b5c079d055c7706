#pragma once

#include <optional>
#include <string>
#include <vector>

#include "solvers/simulator.h"
#include "studies/csv.h"
#include "studies/file.h"
#include "studies/fit/fit.h"
#include "tests/studies/temporary_folder.h"

namespace flyball::test {

/// A study of one model with one fit, for the library's functions.
struct FitCase {
  Study study;
  FitDefinition fit;

  const Plan& plan() const { return *study.models[0].plan; }
  FitResult run(int threads = 1) const;
};

/// From the text of a model. Throws std::invalid_argument with all diagnostics.
FitCase fit_case(const std::string& text, const std::string& file = "model.toml");
/// From a shipped model, by its path below models/.
FitCase shipped_fit_case(const std::string& path);

/// The logged signals of a model as its file has it, at a tolerance of 1e-12.
Log reference_run(const Plan& plan, std::vector<double> times);

/// Times between two ends, both included.
std::vector<double> time_grid(double first, double last, int parts);

/// Sought, without bounds, from a start.
Sought from(const std::string& name, double start);
/// A parameter of the result.
const FittedParameter& found(const FitResult& result, const std::string& name);
bool remarks_contain(const FitResult& result, const std::string& text);

}  // namespace flyball::test
