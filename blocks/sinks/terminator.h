#pragma once
#include "blocks/block.h"

namespace flyball {

struct Terminator : Block {
  static constexpr auto summary = "Ends a signal that nobody reads.";
  static constexpr std::array aliases{"TRASH_f"};
  Input u = input("u", "any", "signal");
};

}  // namespace flyball
