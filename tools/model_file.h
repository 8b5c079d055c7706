#pragma once

#include <memory>
#include <string>
#include <vector>

#include "models/plan.h"

namespace flyball {

/// A model file, read, checked and planned.
struct ModelFile {
  std::string name;
  std::string text;
  std::vector<Diagnostic> diagnostics;  // sorted by position
  int errors = 0;
  std::shared_ptr<const Plan> plan;  // nullptr when there are errors
};

/// Throws FileError when the file cannot be read.
ModelFile load_model(const std::string& file, const std::vector<Override>& overrides);

/// The diagnostics, a line each.
std::string listing(const ModelFile& model);

}  // namespace flyball
