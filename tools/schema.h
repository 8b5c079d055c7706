#pragma once

#include <string>

namespace flyball {

/// A JSON Schema (draft 4, which TOML editors read) of model files, made from the catalogue: names, units,
/// ranges, choices and texts of every block.
std::string model_schema();

/// The same of study files.
std::string study_schema();

}  // namespace flyball
