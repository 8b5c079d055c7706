#pragma once

#include <vector>

#include "models/diagram.h"
#include "models/language/toml.h"

namespace flyball {

/// Writes overrides into the tree of a model, so that they are checked as if they stood in the file.
void apply_overrides(const std::vector<Override>& overrides, TomlValue& root, Diagnostics& diagnostics);

}  // namespace flyball
