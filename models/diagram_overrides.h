#pragma once

#include <vector>

#include "models/diagram.h"
#include "models/language/toml.h"

namespace flyball {

// Overrides are written into the tree of a model, so that they are checked as if they stood in the file.

/// Those of parameters of the model itself.
void apply_to_parameters(const std::vector<Override>& overrides, TomlValue& root, Diagnostics& diagnostics);

/// Override `number`, "….block.setting", into the table of its block.
void apply_to_block(const std::vector<Override>& overrides, int number, TomlEntry& block,
                    Diagnostics& diagnostics);

}  // namespace flyball
