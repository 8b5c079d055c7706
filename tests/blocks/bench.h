#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "blocks/registry.h"
#include "tests/blocks/table_settings.h"

namespace flyball::test {

/// Instances of one block on the bench: their slots in one value array, instance after instance, so that the
/// index map of an instance is its slots in order. Kernels run when the test says so; no engine takes part.
template <class T>
class Bench {
 public:
  explicit Bench(BlockObject object, int copies = 1)
      : object_(std::move(object)),
        size_(static_cast<int>(object_.specification->slots.size())),
        values(size_ * copies, T(0.0)),
        rates(size_ * copies, T(0.0)),
        next(size_ * copies, T(0.0)),
        bits(size_ * copies),
        objects(size_ * copies),
        next_objects(size_ * copies),
        memories(size_ * copies),
        copies_(copies) {
    for (int at = 0; at < size_ * copies; ++at) {
      index_.push_back(at);
      const SlotSpec& slot = spec().slots[at % size_];
      if (slot.make_object != nullptr) objects[at] = slot.make_object();
      if (slot.make_memory != nullptr) memories[at] = slot.make_memory();
    }
  }

  const Specification& spec() const { return *object_.specification; }
  const BlockObject& object() const { return object_; }
  int size() const { return size_; }

  /// Runs a phase of all instances, or of those in [first, first + count). Handlers take the slot of the
  /// crossing that fired. Staged values start from the present ones. Phases that the block does not have do
  /// nothing.
  void run(Phase phase, int first, int count, int crossing = -1) {
    const Kernels<T>& k = object_.type->kernels.template on<T>();
    const Frame<T> frame = this->frame();
    const int* index = index_.data() + first * size_;
    if (!is_handler(phase)) {
      const auto sweep = k.sweep(phase);
      if (sweep != nullptr) sweep(object_.self.get(), frame, index, size_, count);
      return;
    }
    next = values;
    for (int i = 0; i < count; ++i, index += size_) {
      if (phase == Phase::crossing && k.on_crossing != nullptr)
        k.on_crossing(object_.self.get(), frame, index, crossing);
      if (phase == Phase::sample && k.on_sample != nullptr) k.on_sample(object_.self.get(), frame, index);
      if (phase == Phase::time && k.on_time != nullptr) k.on_time(object_.self.get(), frame, index);
    }
  }
  void run(Phase phase) { run(phase, 0, copies_); }

 private:
  Frame<T> frame() {
    Frame<T> frame;
    frame.values = values.data();
    frame.rates = rates.data();
    frame.next = next.data();
    frame.bits = bits.data();
    frame.objects = objects.data();
    frame.next_objects = next_objects.data();
    frame.memories = memories.data();
    return frame;
  }

  BlockObject object_;
  int size_;

 public:
  // By slot of the block, instance after instance.
  std::vector<T> values, rates, next;
  std::vector<unsigned char> bits;
  std::vector<std::shared_ptr<const void>> objects, next_objects;
  std::vector<std::any> memories;

 private:
  int copies_;
  std::vector<int> index_;
};

/// A number that the compiler does not know: it would fold functions of a constant with a rounding of its
/// own.
inline double opaque(double x) {
  volatile double hidden = x;
  return hidden;
}

inline BlockObject create(std::string_view type, Keys keys = {}) {
  const BlockType* found = find_block_type(type);
  if (found == nullptr) throw std::invalid_argument("no block type " + std::string(type));
  if (keys.empty()) return found->create();
  TableSettings settings(std::move(keys));
  BlockObject object = found->create(&settings);
  if (!settings.refused().empty()) throw std::invalid_argument(settings.refused().front());
  return object;
}

/// One instance on double with names instead of slots: what a test of equations reads like.
class Device {
 public:
  explicit Device(std::string_view type, Keys keys = {}) : bench_(create(type, keys)) {
    TableSettings settings(std::move(keys));
    const auto& slots = bench_.spec().slots;
    for (int s = 0; s < bench_.size(); ++s) {
      bench_.values[s] = slots[s].kind == SlotKind::param
                             ? settings.number(slots[s]).value_or(slots[s].fallback)
                             : slots[s].fallback;
    }
    for (int s = 0; s < bench_.size(); ++s) {
      if (slots[s].initial_param >= 0) bench_.values[s] = bench_.values[slots[s].initial_param];
    }
  }

  /// The number of a port, or of a slot.
  double& operator[](std::string_view name) { return bench_.values[slot(name)]; }
  double rate(std::string_view state) { return bench_.rates[slot(state)]; }
  void time(double t) { bench_.values[0] = t; }

  /// Sets the bits of the relations by their values (0 changes nothing), then computes all that is no
  /// handler.
  Device& update() {
    bench_.run(Phase::relations);
    for (int s = 0; s < bench_.size(); ++s) {
      if (bench_.spec().slots[s].kind != SlotKind::relation || bench_.values[s] == 0.0) continue;
      bench_.bits[s] = bench_.values[s] > 0.0;
    }
    bench_.run(Phase::outputs);
    bench_.run(Phase::rates);
    bench_.run(Phase::crossings);
    bench_.run(Phase::schedule);
    return *this;
  }
  /// A handler, and its commit.
  void handle(Phase phase, std::string_view crossing = "") {
    bench_.run(phase, 0, 1, crossing.empty() ? -1 : slot(crossing));
    for (int s = 0; s < bench_.size(); ++s) {
      const SlotKind kind = bench_.spec().slots[s].kind;
      if (kind == SlotKind::state || kind == SlotKind::held) bench_.values[s] = bench_.next[s];
    }
  }
  /// A hit of a sampled block: outputs, then the commit.
  double hit(std::string_view output) {
    update();
    const double y = (*this)[output];
    handle(Phase::sample);
    return y;
  }
  Bench<double>& bench() { return bench_; }

 private:
  int slot(std::string_view name) const {
    if (const PortSpec* port = bench_.spec().port(name)) return port->slots.at(0);
    for (int s = 0; s < bench_.size(); ++s) {
      if (bench_.spec().slots[s].name == name) return s;
    }
    throw std::invalid_argument("no slot " + std::string(name) + " in " + bench_.object().type->name);
  }

  Bench<double> bench_;
};

/// A sampled block that is hit every second.
inline Device sampled(std::string_view type, Keys keys = {}) {
  keys.insert({"sample_time", Rational(1)});
  return Device(type, std::move(keys));
}

}  // namespace flyball::test
