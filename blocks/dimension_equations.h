#pragma once

#include <vector>

#include "blocks/registry.h"

namespace flyball {

/// Runs the equations of a block on Dimensional, in the block's own slots. Each output and next value has the
/// dimension of its slot, a rate that of its state over seconds, an alarm seconds; a relation and a crossing
/// may have any.
std::vector<DimensionEquation> dimension_equations(const BlockType& type, const BlockObject& object);

}  // namespace flyball
