#include "blocks/registry.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "blocks/dimension_equations.h"

namespace flyball {
namespace {

/// Each kind of declaration with the method that it needs, and the other way round.
void check_methods(const BlockType& type, const Specification& spec) {
  const Kernels<double>& has = type.kernels.on_double;
  const auto pair = [&](SlotKind kind, const char* declaration, bool method, const char* name) {
    if (spec.has(kind) && !method) {
      throw std::logic_error(
          fmt::format("block {}: declares {} but has no method {}", type.name, declaration, name));
    }
    if (!spec.may_have(kind) && method) {
      throw std::logic_error(
          fmt::format("block {}: has a method {} but declares no {}", type.name, name, declaration));
    }
  };
  pair(SlotKind::state, "State", has.rates != nullptr, "rates(auto& v) const");
  pair(SlotKind::relation, "Relation", has.relations != nullptr, "relations(auto& v) const");
  pair(SlotKind::crossing, "Crossing", has.crossings != nullptr, "crossings(auto& v) const");
  pair(SlotKind::crossing, "Crossing", has.on_crossing != nullptr, "on_crossing(Crossing c, auto& v) const");
  pair(SlotKind::alarm, "Alarm", has.schedule != nullptr, "schedule(auto& v) const");
  pair(SlotKind::alarm, "Alarm", has.on_time != nullptr, "on_time(auto& v) const");
  const bool computed = std::ranges::any_of(spec.slots, [&](const SlotSpec& slot) {
    const auto at = static_cast<int>(&slot - spec.slots.data());
    return (slot.kind == SlotKind::output &&
            std::ranges::find(spec.passed, at, &PassThrough::output) == spec.passed.end()) ||
           (slot.kind == SlotKind::object_output && !slot.constant);
  });
  if (computed && has.outputs == nullptr) {
    throw std::logic_error(
        fmt::format("block {}: declares Output but has no method outputs(auto& v) const", type.name));
  }
  if (!computed && has.outputs != nullptr) {
    throw std::logic_error(
        fmt::format("block {}: has a method outputs but declares no Output of its own", type.name));
  }
  if (has.on_sample != nullptr && !spec.sampled()) {
    throw std::logic_error(
        fmt::format("block {}: has a method on_sample but declares no SampleTime", type.name));
  }
  if (has.on_step != nullptr && !spec.may_have(SlotKind::memory)) {
    throw std::logic_error(fmt::format("block {}: has a method on_step but declares no Memory", type.name));
  }
  if (spec.count(SlotKind::alarm) > 1) {
    throw std::logic_error(fmt::format("block {}: declares more than one Alarm", type.name));
  }
}

/// Rules that no method shows.
void check_declarations(const BlockType& type, const Specification& spec) {
  if (spec.sampled()) {
    for (const PortSpec& port : spec.ports) {
      const SlotKind kind = spec.slots[port.slots[0]].kind;
      if (!port.is_input && kind == SlotKind::held) {
        throw std::logic_error(fmt::format(
            "block {}: output {} of a sampled block must be latched, so it cannot share a held value's slot",
            type.name, port.name));
      }
    }
  }
  if (!type.differentiable &&
      (!spec.sampled() || spec.has(SlotKind::state) || spec.has(SlotKind::relation))) {
    throw std::logic_error(fmt::format(
        "block {}: a block on double alone must be sampled, without State and Relation", type.name));
  }
}

/// Runs the equations on Dependency, in the block's own slots.
class Deriver {
 public:
  Deriver(const BlockType& type, const BlockObject& object)
      : type_(type),
        object_(object),
        spec_(*object.specification),
        size_(static_cast<int>(spec_.slots.size())),
        values_(size_),
        rates_(size_),
        index_(size_),
        objects_(size_),
        memories_(size_) {
    for (int s = 0; s < size_; ++s) {
      index_[s] = s;
      if (spec_.slots[s].make_object) objects_[s] = spec_.slots[s].make_object();
      if (spec_.slots[s].make_memory != nullptr) memories_[s] = spec_.slots[s].make_memory();
      if (spec_.slots[s].kind == SlotKind::object_input) object_inputs_.read(Dependency::on(s));
    }
    stand_for_themselves();
    frame_.values = values_.data();
    frame_.rates = rates_.data();
    frame_.objects = frame_.next_objects = objects_.data();
    frame_.memories = memories_.data();
  }

  void run(BlockObject& result) {
    const Kernels<Dependency>& kernels = type_.kernels.on_dependency;
    result.reads.resize(size_);
    result.rate_reads.resize(size_);
    result.affine.resize(size_);
    result.rate_affine.resize(size_);
    collect(kernels.outputs, SlotKind::output, values_, result.reads, result.affine);
    // Outputs now count as read by their own slots: rates and relations that use them come after them.
    stand_for_themselves();
    collect(kernels.relations, SlotKind::relation, values_, result.reads, result.affine);
    collect(kernels.crossings, SlotKind::crossing, values_, result.reads, result.affine);
    collect(kernels.schedule, SlotKind::alarm, values_, result.reads, result.affine);
    collect(kernels.rates, SlotKind::state, rates_, result.rate_reads, result.rate_affine);
  }

 private:
  void stand_for_themselves() {
    for (int s = 0; s < size_; ++s) {
      const SlotKind kind = spec_.slots[s].kind;
      values_[s] = Dependency::on(s, kind != SlotKind::param && kind != SlotKind::held);
    }
  }

  void collect(Kernels<Dependency>::Sweep sweep, SlotKind kind, std::vector<Dependency>& written,
               std::vector<std::vector<int>>& reads, std::vector<bool>& affine) {
    if (sweep == nullptr) return;
    // A slot past the last marks what was never written.
    for (int s = 0; s < size_; ++s) {
      if (is_result(s, kind)) written[s] = Dependency::on(size_);
    }
    sweep(object_.self.get(), frame_, index_.data(), size_, 1);
    for (int s = 0; s < size_; ++s) {
      if (!is_result(s, kind)) continue;
      affine[s] = written[s].affine();
      // What is taken from an object leaves no trace: all of the block is taken to read it.
      written[s].read(object_inputs_);
      reads[s] = written[s].slots();
      if (!reads[s].empty() && reads[s].back() == size_) {
        throw std::logic_error(fmt::format("block {}: {} is never written", type_.name, spec_.slots[s].name));
      }
    }
  }

  bool is_result(int s, SlotKind kind) const {
    return spec_.slots[s].kind == kind &&
           std::ranges::find(spec_.passed, s, &PassThrough::output) == spec_.passed.end();
  }

  const BlockType& type_;
  const BlockObject& object_;
  const Specification& spec_;
  int size_;
  std::vector<Dependency> values_, rates_;
  std::vector<int> index_;
  std::vector<std::shared_ptr<const void>> objects_;
  std::vector<std::any> memories_;
  Dependency object_inputs_;
  Frame<Dependency> frame_;
};

/// A block on double alone cannot be run on Dependency: each output is taken to read every input and held
/// value.
void assume_all_inputs(const Specification& spec, BlockObject& object) {
  std::vector<int> all;
  for (int s = 0; s < static_cast<int>(spec.slots.size()); ++s) {
    const SlotKind kind = spec.slots[s].kind;
    if (kind == SlotKind::input || kind == SlotKind::held || kind == SlotKind::param ||
        kind == SlotKind::object_input) {
      all.push_back(s);
    }
  }
  object.reads.resize(spec.slots.size());
  object.rate_reads.resize(spec.slots.size());
  object.affine.resize(spec.slots.size());
  object.rate_affine.resize(spec.slots.size());
  for (int s = 0; s < static_cast<int>(spec.slots.size()); ++s) {
    const SlotKind kind = spec.slots[s].kind;
    if (kind == SlotKind::output || kind == SlotKind::object_output) object.reads[s] = all;
  }
}

}  // namespace

BlockObject BlockType::create(Settings* settings) const {
  BlockObject object;
  object.type = this;
  const std::shared_ptr<const Block> block = construct(settings);
  object.specification = &block->specification();
  object.self = std::shared_ptr<const void>(block, self(*block));
  if (object.specification->refused) {
    if (settings == nullptr) throw std::logic_error(fmt::format("block {}: refuses its own defaults", name));
    return object;
  }
  check_methods(*this, *object.specification);
  check_declarations(*this, *object.specification);
  if (differentiable) {
    Deriver(*this, object).run(object);
    object.dimensions = dimension_equations(*this, object);
  } else {
    assume_all_inputs(*object.specification, object);
  }
  return object;
}

}  // namespace flyball
