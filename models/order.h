#pragma once

#include <optional>
#include <string>
#include <vector>

#include "models/diagram.h"
#include "models/graph.h"

namespace flyball {

/// Outputs (nodes) that need each other at the same time: with the tears given, each member follows those
/// that it reads. A single output without a tear needs nothing but what comes before it.
struct Knot {
  std::vector<int> tears;
  std::vector<int> members;  // the tears among them
};

/// A strongly connected component of all reads. Bits are decided by relations, so where they stand still less
/// is in a cycle; between hits the outputs of sampled blocks stand still, too.
struct Cycle {
  int level = 0;
  std::vector<int> relations;  // nodes; where there are any, the outputs depend on their bits
  std::vector<Knot> at_hits;   // all outputs, in the order of evaluation for given bits
  std::vector<Knot> in_steps;  // those of unsampled blocks
  std::string chain;           // "sum.y -> k.u -> k.y -> sum.u2 -> sum.y"
  int begins = -1;             // instance
};

/// Which output and relation is evaluated after which. A node is one slot of one instance.
class Order {
 public:
  /// Resolves wires through pass-through blocks and sorts. Reports algebraic loops that cannot be solved;
  /// then the result is empty.
  static std::optional<Order> of(const Diagram& diagram, Diagnostics& diagnostics);

  int node(int instance, int local) const { return base_[instance] + local; }
  int node(Endpoint e) const { return node(e.instance, e.slot); }
  int nodes() const { return base_.back(); }
  Endpoint endpoint(int node) const;

  /// Outputs and relations of level n read only those of lower levels, and those of their own cycle. -1: not
  /// evaluated (inputs, states, …).
  int level(int node) const { return level_[node]; }
  int levels() const { return levels_; }

  const std::vector<Cycle>& cycles() const { return cycles_; }
  /// The cycle of a node; -1 when it is in none.
  int cycle(int node) const { return cycle_[node]; }

  /// What an input stands for: an output, state or held value of a block, never a pass-through. Not connected
  /// when an optional input is left open.
  Endpoint source(int instance, int local) const { return source_[node(instance, local)]; }

  /// Calls `visit(Endpoint)` with each output and relation that stands behind slots `reads` of an instance.
  template <class Visit>
  void behind(int instance, const std::vector<int>& reads, Visit visit) const;

 private:
  explicit Order(const Diagram& diagram);
  void resolve_sources(Diagnostics& diagnostics);
  void sort();
  Graph reads() const;
  void find_cycles(const Graph& graph, const Components& components);
  Graph among(const std::vector<int>& nodes) const;
  std::vector<bool> guessed(const std::vector<int>& nodes) const;
  std::vector<Knot> knots(const std::vector<int>& outputs) const;
  void check_guesses(Diagnostics& diagnostics) const;
  /// The node of an output, through pass-throughs.
  int behind_port(Endpoint e) const;
  void check(const Cycle& cycle, Diagnostics& diagnostics) const;
  std::vector<Endpoint> loop_of(int member) const;
  std::string chain_of(const std::vector<Endpoint>& loop) const;
  const Specification& spec(int instance) const {
    return *diagram_->instances[instance].object->specification;
  }
  /// Slots that are computed during a sweep, or stand for another one that is.
  bool evaluated(Endpoint e) const;
  bool computed(Endpoint e) const;

  const Diagram* diagram_;
  std::vector<int> base_;
  std::vector<Endpoint> source_;
  std::vector<int> level_;
  int levels_ = 0;
  std::vector<int> cycle_;
  std::vector<Cycle> cycles_;
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
