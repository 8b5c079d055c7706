#pragma once

#include <vector>

#include "models/diagram_blocks.h"

namespace flyball {

/// The signals that `log` of [diagram] names, in its order, vectors expanded. Without `log` (nullptr): the
/// outputs of the model's ports; without these, the outputs of the blocks and subsystems of the model that
/// feed no other one, or of all when each feeds one.
std::vector<Logged> read_log(const TomlValue* log, const ModelBlocks& blocks);

}  // namespace flyball
