#pragma once

#include <optional>
#include <vector>

#include "models/diagram.h"

namespace flyball {

/// Which output and relation is evaluated after which. A node is one slot of one instance.
class Order {
 public:
  /// Resolves wires through pass-through blocks and sorts. Reports algebraic loops; then the result is empty.
  static std::optional<Order> of(const Diagram& diagram, Diagnostics& diagnostics);

  int node(int instance, int local) const { return base_[instance] + local; }
  int node(Endpoint e) const { return node(e.instance, e.slot); }
  int nodes() const { return base_.back(); }
  Endpoint endpoint(int node) const;

  /// Outputs and relations of level n read only those of lower levels. -1: not evaluated (inputs, states, …).
  int level(int node) const { return level_[node]; }
  int levels() const { return levels_; }

  /// What an input stands for: an output, state or held value of a block, never a pass-through. Not connected
  /// when an optional input is left open.
  Endpoint source(int instance, int local) const { return source_[node(instance, local)]; }

  /// Calls `visit(Endpoint)` with each output and relation that stands behind slots `reads` of an instance.
  template <class Visit>
  void behind(int instance, const std::vector<int>& reads, Visit visit) const;

 private:
  explicit Order(const Diagram& diagram);
  void resolve_sources(Diagnostics& diagnostics);
  bool sort();
  void report_loop(Diagnostics& diagnostics) const;
  std::vector<Endpoint> find_loop() const;
  const Specification& spec(int instance) const {
    return *diagram_->instances[instance].object->specification;
  }
  /// Slots that are computed during a sweep.
  bool evaluated(Endpoint e) const;

  const Diagram* diagram_;
  std::vector<int> base_;
  std::vector<Endpoint> source_;
  std::vector<int> level_;
  int levels_ = 0;
};

template <class Visit>
void Order::behind(int instance, const std::vector<int>& reads, Visit visit) const {
  for (const int local : reads) {
    const SlotKind kind = spec(instance).slots[local].kind;
    const bool wired = kind == SlotKind::input || kind == SlotKind::object_input ||
                       (kind == SlotKind::output && source_[node(instance, local)].connected());
    const Endpoint e = wired ? source_[node(instance, local)] : Endpoint{instance, local};
    if (e.connected() && evaluated(e)) visit(e);
  }
}

}  // namespace flyball
