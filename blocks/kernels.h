#pragma once

#include <concepts>
#include <vector>

#include "blocks/isa.h"
#include "blocks/specification.h"
#include "blocks/view.h"

namespace flyball {

/// The compiled equations of a block type on one scalar. A sweep runs `count` instances whose index maps
/// stand `stride` apart; a handler runs one instance.
template <class T>
struct Kernels {
  using Sweep = void (*)(const void* block, const Frame<T>& frame, const int* index, int stride, int count);
  using Handler = void (*)(const void* block, const Frame<T>& frame, const int* index);
  using CrossingHandler = void (*)(const void* block, const Frame<T>& frame, const int* index, int crossing);

  Sweep outputs = nullptr;
  Sweep rates = nullptr;
  Sweep relations = nullptr;
  Sweep crossings = nullptr;
  Sweep schedule = nullptr;
  Sweep on_step = nullptr;
  Handler on_sample = nullptr;
  Handler on_time = nullptr;
  CrossingHandler on_crossing = nullptr;

  /// What answers a phase that is no handler; null when the block has no such method.
  Sweep sweep(Phase phase) const {
    switch (phase) {
      case Phase::outputs:
        return outputs;
      case Phase::rates:
        return rates;
      case Phase::relations:
        return relations;
      case Phase::crossings:
        return crossings;
      case Phase::step:
        return on_step;
      default:
        return schedule;
    }
  }
};

/// The kind of slot that a phase writes, for a phase that is no handler. Of a state it is the rate.
constexpr SlotKind result_of(Phase phase) {
  switch (phase) {
    case Phase::outputs:
      return SlotKind::output;
    case Phase::rates:
      return SlotKind::state;
    case Phase::relations:
      return SlotKind::relation;
    case Phase::crossings:
      return SlotKind::crossing;
    case Phase::step:
      return SlotKind::memory;
    default:
      return SlotKind::alarm;
  }
}

/// The equations of a block type on each scalar. Room for more: a scalar is one more member.
struct KernelTable {
  Kernels<double> on_double;
  Kernels<Jet> on_jet;
  Kernels<Dependency> on_dependency;
  Kernels<Lanes<Isa::baseline>> on_baseline_lanes;
  Kernels<Lanes<Isa::avx2>> on_avx2_lanes;  // empty where the machine does not support it
  Kernels<Dimensional> on_dimensional;

  template <class T>
  const Kernels<T>& on() const {
    if constexpr (std::same_as<T, double>) {
      return on_double;
    } else if constexpr (std::same_as<T, Jet>) {
      return on_jet;
    } else if constexpr (std::same_as<T, Lanes<Isa::baseline>>) {
      return on_baseline_lanes;
    } else if constexpr (std::same_as<T, Lanes<Isa::avx2>>) {
      return on_avx2_lanes;
    } else if constexpr (std::same_as<T, Dependency>) {
      return on_dependency;
    } else {
      return on_dimensional;
    }
  }
};

namespace kernel {

// What a block type defines is found by asking whether the call compiles; a method that is misspelt, or not
// const, is missing, and its declaration is then refused at registration.
template <class B, class V>
concept Outputs = requires(const B& b, V& v) {
  b.outputs(v);
};
template <class B, class V>
concept Rates = requires(const B& b, V& v) {
  b.rates(v);
};
template <class B, class V>
concept RelationsOf = requires(const B& b, V& v) {
  b.relations(v);
};
template <class B, class V>
concept CrossingsOf = requires(const B& b, V& v) {
  b.crossings(v);
};
template <class B, class V>
concept Schedule = requires(const B& b, V& v) {
  b.schedule(v);
};
template <class B, class V>
concept OnStep = requires(const B& b, V& v) {
  b.on_step(v);
};
template <class B, class V>
concept OnSample = requires(const B& b, V& v) {
  b.on_sample(v);
};
template <class B, class V>
concept OnTime = requires(const B& b, V& v) {
  b.on_time(v);
};
template <class B, class V>
concept OnCrossing = requires(const B& b, V& v, Crossing c) {
  b.on_crossing(c, v);
};

/// Runs `method(block, view)` on each instance of a batch.
template <class B, class T, Phase phase, auto method>
void sweep(const void* block, const Frame<T>& frame, const int* index, int stride, int count) {
  const B& self = *static_cast<const B*>(block);
  for (int i = 0; i < count; ++i) {
    View<T, phase> view(frame, index + static_cast<std::ptrdiff_t>(i) * stride);
    method(self, view);
  }
}

template <class B, class T, Phase phase, auto method>
void handle(const void* block, const Frame<T>& frame, const int* index) {
  View<T, phase> view(frame, index);
  method(*static_cast<const B*>(block), view);
}

template <class B, class T>
void handle_crossing(const void* block, const Frame<T>& frame, const int* index, int crossing) {
  View<T, Phase::crossing> view(frame, index);
  static_cast<const B*>(block)->on_crossing(Crossing{crossing}, view);
}

template <class B, class T>
Kernels<T> compile() {
  Kernels<T> k;
  if constexpr (Outputs<B, View<T, Phase::outputs>>) {
    k.outputs = sweep<B, T, Phase::outputs, [](const B& b, auto& v) { b.outputs(v); }>;
  }
  if constexpr (Rates<B, View<T, Phase::rates>>) {
    k.rates = sweep<B, T, Phase::rates, [](const B& b, auto& v) { b.rates(v); }>;
  }
  if constexpr (RelationsOf<B, View<T, Phase::relations>>) {
    k.relations = sweep<B, T, Phase::relations, [](const B& b, auto& v) { b.relations(v); }>;
  }
  if constexpr (CrossingsOf<B, View<T, Phase::crossings>>) {
    k.crossings = sweep<B, T, Phase::crossings, [](const B& b, auto& v) { b.crossings(v); }>;
  }
  if constexpr (Schedule<B, View<T, Phase::schedule>>) {
    k.schedule = sweep<B, T, Phase::schedule, [](const B& b, auto& v) { b.schedule(v); }>;
  }
  // What is remembered has no derivative: a Jet run remembers through the shim.
  if constexpr (std::same_as<T, double>) {
    if constexpr (OnStep<B, View<T, Phase::step>>) {
      k.on_step = sweep<B, T, Phase::step, [](const B& b, auto& v) { b.on_step(v); }>;
    }
  }
  if constexpr (OnSample<B, View<T, Phase::sample>>) {
    k.on_sample = handle<B, T, Phase::sample, [](const B& b, auto& v) { b.on_sample(v); }>;
  }
  if constexpr (OnTime<B, View<T, Phase::time>>) {
    k.on_time = handle<B, T, Phase::time, [](const B& b, auto& v) { b.on_time(v); }>;
  }
  if constexpr (OnCrossing<B, View<T, Phase::crossing>>) k.on_crossing = handle_crossing<B, T>;
  return k;
}

/// A block that runs on double alone says `static constexpr bool differentiable = false`.
template <class B>
constexpr bool differentiable() {
  if constexpr (requires { B::differentiable; }) {
    return B::differentiable;
  } else {
    return true;
  }
}

}  // namespace kernel
}  // namespace flyball
