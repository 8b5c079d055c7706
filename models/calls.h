#pragma once

#include <vector>

#include "models/order.h"
#include "models/plan.h"

namespace flyball {

/// Adds a call of the instance at `place`. One that follows the last one's instances joins its batch.
void append_call(const Plan& plan, Program& program, Phase phase, int place, bool may_join = true);

/// The calls of a knot with tears, one time round; `place_of` tells where each instance is placed.
struct LoopCalls {
  Loop loop;
  std::vector<Op> ops;
};
LoopCalls write_loop(const Plan& plan, const Order& order, const Knot& knot,
                     const std::vector<int>& place_of);

}  // namespace flyball
