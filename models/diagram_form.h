#pragma once

#include <memory>
#include <vector>

#include "blocks/registry.h"

namespace flyball {

/// A block object, with what instances of it have in common.
struct BlockForm {
  explicit BlockForm(BlockObject block);

  std::shared_ptr<const BlockObject> object;
  std::vector<int> params;      // slots
  std::vector<int> inputs;      // slots, of numbers and objects
  std::vector<int> input_rank;  // of a slot: its place in `inputs`, or -1

  const Specification& specification() const { return *object->specification; }
};

}  // namespace flyball
