#pragma once

#include <any>
#include <memory>

#include "blocks/handles.h"
#include "blocks/scalar.h"

namespace flyball {

/// What a block is asked for. The phase is part of the view's type: what it forbids does not compile.
enum class Phase { outputs, rates, relations, crossings, schedule, step, sample, crossing, time };

inline constexpr bool is_handler(Phase phase) { return phase >= Phase::sample; }

/// The arrays of one run, as a kernel sees them. Made anew for each call, so a workspace can be copied.
template <class T>
struct Frame {
  T* values = nullptr;                  // the value array
  T* rates = nullptr;                   // of state s at s - first_state
  T* next = nullptr;                    // staged states and held values, at slot - first_state
  const unsigned char* bits = nullptr;  // of relation r at r - first_relation; one bit a lane
  int first_state = 0;
  int first_relation = 0;
  std::shared_ptr<const void>* objects = nullptr;
  std::shared_ptr<const void>* next_objects = nullptr;
  std::any* memories = nullptr;
};

/// A slot that may be written, not read.
template <class T>
class Target {
 public:
  explicit Target(T& slot) : slot_(slot) {}
  void operator=(const T& x) { slot_ = x; }
  void operator=(double x) requires(!std::is_same_v<T, double>) { slot_ = T(x); }

 private:
  T& slot_;
};

/// One instance in one phase: `v[handle]` is the number that the handle stands for.
template <class T, Phase phase>
class View {
 public:
  View(const Frame<T>& frame, const int* index) : frame_(frame), index_(index) {}

  const T& operator[](Param p) const { return value(p); }
  const T& operator[](Input u) const { return value(u); }
  const T& operator[](State x) const { return value(x); }
  const T& operator[](Held h) const { return value(h); }
  const T& operator[](SampleTime ts) const { return value(ts); }
  const T& operator[](Output y) const requires(phase != Phase::outputs) { return value(y); }
  Target<T> operator[](Output y) const requires(phase == Phase::outputs) { return target(y); }
  Target<T> operator[](Relation r) const requires(phase == Phase::relations) { return target(r); }
  Target<T> operator[](Crossing c) const requires(phase == Phase::crossings) { return target(c); }
  Target<T> operator[](Alarm a) const requires(phase == Phase::schedule) { return target(a); }

  /// The time derivative of a state.
  Target<T> rate(State x) const requires(phase == Phase::rates) {
    return Target<T>(frame_.rates[index_[x.slot] - frame_.first_state]);
  }

  /// The value that a state or held value takes when this instant commits.
  Target<T> next(State x) const requires(is_handler(phase)) { return staged(x); }
  Target<T> next(Held h) const requires(is_handler(phase)) { return staged(h); }

  /// Whether a relation is on. The engine owns the bit: it never changes during a step.
  Bit<T> on(Relation r) const {
    if constexpr (std::is_same_v<T, Dependency>) {
      return {Dependency::on(index_[r.slot])};
    } else if constexpr (std::is_same_v<T, Dimensional>) {
      return false;
    } else {
      return Bit<T>(frame_.bits[index_[r.slot] - frame_.first_relation]);
    }
  }

  /// Whether a held value is not zero. Held values change at events only, so this is no branch on a signal.
  Bit<T> on(Held h) const {
    if constexpr (std::is_same_v<T, Dependency>) {
      return {value(h)};
    } else if constexpr (std::is_same_v<T, Dimensional>) {
      return false;
    } else {
      return nonzero(value(h));
    }
  }

  const T& time() const { return frame_.values[index_[0]]; }

  /// A number without meaning of its own, in the scalar of this run: where a sum starts.
  static T number(double x) { return T(x); }
  /// The number of a parameter that is absent where the model has a literal 0.
  T number(Param p) const { return p.declared() ? value(p) : T(0.0); }

  template <class O>
  const O& operator[](ObjectInput<O> port) const {
    return *static_cast<const O*>(frame_.objects[index_[port.slot]].get());
  }
  template <class O>
  O& operator[](Memory<O> memory) const
      requires(phase == Phase::outputs || phase == Phase::step || is_handler(phase)) {
    return *std::any_cast<O>(&frame_.memories[index_[memory.slot]]);
  }

  /// Makes an object visible: in `outputs` to all who read it later in this sweep, in a handler at the
  /// commit.
  template <class O>
  void publish(ObjectOutput<O> port, std::shared_ptr<const O> object) const
      requires(phase == Phase::outputs || is_handler(phase)) {
    (phase == Phase::outputs ? frame_.objects : frame_.next_objects)[index_[port.slot]] = std::move(object);
  }

 private:
  const T& value(auto handle) const { return frame_.values[index_[handle.slot]]; }
  Target<T> target(auto handle) const { return Target<T>(frame_.values[index_[handle.slot]]); }
  Target<T> staged(auto handle) const {
    return Target<T>(frame_.next[index_[handle.slot] - frame_.first_state]);
  }

  const Frame<T>& frame_;
  const int* index_;
};

}  // namespace flyball
