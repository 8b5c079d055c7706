#pragma once

#include <vector>

#include "models/diagram_blocks.h"
#include "models/diagram_report.h"

namespace flyball {

/// The signals that `log` of [diagram] names, in its order, vectors expanded. Without `log` (nullptr): the
/// outputs of the blocks that feed no other, or of all blocks when each feeds one.
std::vector<Logged> read_log(const TomlValue* log, const ModelBlocks& blocks, Report& report);

}  // namespace flyball
