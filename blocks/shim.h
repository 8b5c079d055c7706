#pragma once

#include "blocks/jet.h"
#include "blocks/kernels.h"

namespace flyball::kernel {

/// Runs a block that exists on double alone inside a Jet run: its numbers are gathered into local doubles,
/// its double kernel runs, and what it wrote is scattered back with zero derivatives.
template <class B>
class Shim {
 public:
  Shim(const Specification& spec, const Frame<Jet>& frame, const int* index)
      : spec_(spec), outer_(frame), index_(index), map_(index, index + spec.slots.size()) {
    const int n = static_cast<int>(spec.slots.size());
    values_.resize(n);
    rates_.resize(n);
    next_.resize(n);
    bits_.resize(n);
    for (int s = 0; s < n; ++s) {
      if (!spec.slots[s].numeric()) continue;
      map_[s] = s;
      values_[s] = outer_.values[index[s]].a;
      if (staged(s)) next_[s] = outer_.next[index[s] - outer_.first_state].a;
      if (spec.slots[s].kind == SlotKind::relation) bits_[s] = outer_.bits[index[s] - outer_.first_relation];
    }
    inner_.values = values_.data();
    inner_.rates = rates_.data();
    inner_.next = next_.data();
    inner_.bits = bits_.data();
    inner_.objects = outer_.objects;
    inner_.next_objects = outer_.next_objects;
    inner_.memories = outer_.memories;
  }

  const Frame<double>& frame() const { return inner_; }
  const int* index() const { return map_.data(); }

  void scatter(Phase phase) {
    for (int s = 0; s < static_cast<int>(spec_.slots.size()); ++s) {
      const SlotKind kind = spec_.slots[s].kind;
      if (phase == Phase::rates && kind == SlotKind::state) {
        outer_.rates[index_[s] - outer_.first_state] = Jet(rates_[s]);
      } else if (is_handler(phase) && staged(s)) {
        outer_.next[index_[s] - outer_.first_state] = Jet(next_[s]);
      } else if (written(phase, kind)) {
        outer_.values[index_[s]] = Jet(values_[s]);
      }
    }
  }

 private:
  bool staged(int s) const {
    return spec_.slots[s].kind == SlotKind::state || spec_.slots[s].kind == SlotKind::held;
  }
  static bool written(Phase phase, SlotKind kind) {
    return (phase == Phase::outputs && kind == SlotKind::output) ||
           (phase == Phase::relations && kind == SlotKind::relation) ||
           (phase == Phase::crossings && kind == SlotKind::crossing) ||
           (phase == Phase::schedule && kind == SlotKind::alarm);
  }

  const Specification& spec_;
  const Frame<Jet>& outer_;
  const int* index_;
  std::vector<int> map_;
  std::vector<double> values_, rates_, next_;
  std::vector<unsigned char> bits_;
  Frame<double> inner_;
};

template <class B, Phase phase, auto method>
void shim_sweep(const void* block, const Frame<Jet>& frame, const int* index, int stride, int count) {
  const B& self = *static_cast<const B*>(block);
  for (int i = 0; i < count; ++i) {
    Shim<B> shim(self.specification(), frame, index + static_cast<std::ptrdiff_t>(i) * stride);
    View<double, phase> view(shim.frame(), shim.index());
    method(self, view);
    shim.scatter(phase);
  }
}

template <class B, Phase phase, auto method>
void shim_handle(const void* block, const Frame<Jet>& frame, const int* index) {
  shim_sweep<B, phase, method>(block, frame, index, 0, 1);
}

/// The Jet kernels of a block on double alone. Such a block is sampled, so it has no rates and no relations.
template <class B>
Kernels<Jet> compile_shim() {
  Kernels<Jet> k;
  if constexpr (Outputs<B, View<double, Phase::outputs>>) {
    k.outputs = shim_sweep<B, Phase::outputs, [](const B& b, auto& v) { b.outputs(v); }>;
  }
  if constexpr (OnSample<B, View<double, Phase::sample>>) {
    k.on_sample = shim_handle<B, Phase::sample, [](const B& b, auto& v) { b.on_sample(v); }>;
  }
  return k;
}

}  // namespace flyball::kernel
