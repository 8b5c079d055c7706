#pragma once

#include <memory>
#include <string>
#include <vector>

#include "models/plan.h"
#include "studies/metrics/criteria.h"

namespace flyball {

/// A model file, read, checked and planned.
struct ModelFile {
  std::string name;
  std::string text;
  std::vector<Diagnostic> diagnostics;  // sorted by position
  int errors = 0;
  std::shared_ptr<const Plan> plan;  // nullptr when there are errors
  Criteria criteria;                 // of its own
};

/// Throws FileError when the file cannot be read.
ModelFile load_model(const std::string& file, const std::vector<Override>& overrides);

/// A line each.
std::string listing(const std::vector<Diagnostic>& diagnostics);

}  // namespace flyball
