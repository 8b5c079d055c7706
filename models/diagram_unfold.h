#pragma once

#include "models/diagram.h"
#include "models/diagram_blocks.h"

namespace flyball {

/// Moves the blocks into the diagram. Wires go through the ports of subsystems, which are no blocks, to what
/// stands behind them; the sources of `diagram.logged` become those of the diagram.
void unfold(ModelBlocks& blocks, Diagram& diagram);

}  // namespace flyball
