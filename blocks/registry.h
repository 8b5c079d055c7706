#pragma once

#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "blocks/block.h"
#include "blocks/kernels.h"

namespace flyball {

struct BlockType;

/// A constructed block: type and structure. Immutable; all instances of equal structure share one.
struct BlockObject {
  const BlockType* type = nullptr;
  std::shared_ptr<const void> self;              // the block itself, for its kernels
  const Specification* specification = nullptr;  // lives in `self`
  /// What each output, relation, crossing and alarm (by slot), and the rate of each state, reads: slots of
  /// this block, ascending. Found by running the equations on Dependency.
  std::vector<std::vector<int>> reads;
  std::vector<std::vector<int>> rate_reads;
  /// Whether each of these results is an affine function of inputs, states and time, as long as bits and held
  /// values stand still.
  std::vector<bool> affine;
  std::vector<bool> rate_affine;
  /// What the equations demand of units; slot s is unknown `slot_unknown(s)`, a literal of a formula the one
  /// that Formula says. Found by running the equations on Dimensional; empty for a block on double alone.
  std::vector<DimensionEquation> dimensions;

  static int slot_unknown(int slot) { return base_units + slot; }
};

/// One line of the catalogue.
struct BlockType {
  std::string name;
  std::string family;
  std::string summary;
  std::vector<std::string> aliases;  // what Modelica and Xcos call it
  bool differentiable = true;
  KernelTable kernels;
  std::shared_ptr<const Block> (*construct)(Settings* settings) = nullptr;
  const void* (*self)(const Block& block) = nullptr;  // the address that kernels expect

  /// Constructs from settings (nullptr: defaults) and derives what reads what. Throws std::logic_error when
  /// declarations and methods of the block do not agree: a mistake in the block, not in a model. Where the
  /// block refused its settings, `specification->refused` is set and nothing is derived.
  BlockObject create(Settings* settings = nullptr) const;
};

/// All block types, in the order of the catalogue, and then those that were added. Throws std::logic_error as
/// `create` does.
const std::deque<BlockType>& catalogue();

/// Adds a block of another program to those of the catalogue, before it reads its first model. Throws
/// std::logic_error as `create` does, and when the name is taken.
void add_block_type(BlockType type);

/// By name or alias; nullptr when there is none.
const BlockType* find_block_type(std::string_view name);

/// All that `find_block_type` finds: names in the order of the catalogue, each before its aliases.
const std::vector<std::string>& block_type_names();

/// The equations of a block on Jets. Defined in blocks/jet_kernels.h; of the catalogue's blocks in a
/// translation unit of its own, so that all others compile without Eigen.
template <class B>
Kernels<Jet> jet_kernels();

/// Describes a block type; `family` is its folder.
template <class B>
BlockType describe(std::string name, std::string family) {
  BlockType type;
  type.name = std::move(name);
  type.family = std::move(family);
  type.summary = B::summary;
  if constexpr (requires { B::aliases; }) type.aliases.assign(B::aliases.begin(), B::aliases.end());
  type.differentiable = kernel::differentiable<B>();
  type.kernels.on_double = kernel::compile<B, double>();
  type.kernels.on_jet = jet_kernels<B>();
  if constexpr (kernel::differentiable<B>()) {
    type.kernels.on_dependency = kernel::compile<B, Dependency>();
    type.kernels.on_dimensional = kernel::compile<B, Dimensional>();
  }
  type.construct = [](Settings* settings) -> std::shared_ptr<const Block> {
    std::shared_ptr<B> block;
    if constexpr (std::is_aggregate_v<B>) {
      block.reset(new B{Block(settings)});
    } else {
      block = std::make_shared<B>(settings);
    }
    block->seal();
    return block;
  };
  type.self = [](const Block& block) -> const void* { return static_cast<const B*>(&block); };
  return type;
}

/// The equations of a block on lanes: empty for one on double alone. Defined in blocks/lane_kernels.h.
template <class B, Isa isa>
Kernels<Lanes<isa>> lane_kernels();

/// Adds the equations on lanes, as far as this machine can run them.
template <class B>
BlockType with_lanes(BlockType type) {
  type.kernels.on_baseline_lanes = lane_kernels<B, Isa::baseline>();
  if constexpr (compiled_for_avx2) {
    if (supports(Isa::avx2)) type.kernels.on_avx2_lanes = lane_kernels<B, Isa::avx2>();
  }
  return type;
}

/// Defined once for each block, in the translation unit of its family.
template <class B>
BlockType block_type();

}  // namespace flyball
