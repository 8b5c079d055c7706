#include "models/order.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace flyball {

Order::Order(const Diagram& diagram) : diagram_(&diagram) {
  base_.push_back(0);
  for (const Instance& instance : diagram.instances) {
    base_.push_back(base_.back() + static_cast<int>(instance.object->specification->slots.size()));
  }
  source_.resize(nodes());
  level_.assign(nodes(), -1);
  cycle_.assign(nodes(), -1);
}

std::optional<Order> Order::of(const Diagram& diagram, Diagnostics& diagnostics) {
  Order order(diagram);
  const int before = diagnostics.errors();
  order.resolve_sources(diagnostics);
  if (diagnostics.errors() > before) return std::nullopt;
  order.sort();
  order.check_guesses(diagnostics);
  for (const Cycle& cycle : order.cycles_) order.check(cycle, diagnostics);
  return diagnostics.errors() > before ? std::nullopt : std::optional(std::move(order));
}

Endpoint Order::endpoint(int node) const {
  const auto after = std::ranges::upper_bound(base_, node);
  const int instance = static_cast<int>(after - base_.begin()) - 1;
  return {instance, node - base_[instance]};
}

bool Order::evaluated(Endpoint e) const {
  const SlotSpec& slot = spec(e.instance).slots[e.slot];
  return slot.kind == SlotKind::output || slot.kind == SlotKind::relation ||
         (slot.kind == SlotKind::object_output && !slot.constant);
}

bool Order::computed(Endpoint e) const { return evaluated(e) && !source_[node(e)].connected(); }

void Order::resolve_sources(Diagnostics& diagnostics) {
  const int n = static_cast<int>(diagram_->instances.size());
  std::vector<int> through(nodes(), -1);  // of a passed output: node of the input that it is
  for (int i = 0; i < n; ++i) {
    for (const PassThrough& pass : spec(i).passed) through[node(i, pass.output)] = node(i, pass.input);
    for (const auto& [slot, from] : diagram_->instances[i].inputs) source_[node(i, slot)] = from;
  }
  const auto follow = [&](int start, Endpoint from) {
    // A chain of pass-throughs longer than there are nodes goes round in a circle.
    for (int hops = 0; from.connected() && through[node(from)] >= 0; ++hops) {
      if (hops > nodes()) {
        const Instance& at = diagram_->instances[endpoint(start).instance];
        diagnostics.error(
            at.at,
            fmt::format("algebraic loop: {} only passes its own output on, so nothing gives it a value",
                        at.name));
        return Endpoint{};
      }
      from = source_[through[node(from)]];
    }
    return from;
  };
  // Resolved into a copy: `follow` needs the wires as they were drawn.
  std::vector<Endpoint> resolved = source_;
  for (int i = 0; i < n; ++i) {
    for (const auto& [slot, from] : diagram_->instances[i].inputs)
      resolved[node(i, slot)] = follow(node(i, slot), from);
    for (const PassThrough& pass : spec(i).passed) {
      resolved[node(i, pass.output)] = follow(node(i, pass.output), {i, pass.output});
    }
  }
  source_ = std::move(resolved);
}

/// An edge leads from each output and relation to those that read it.
Graph Order::reads() const {
  std::vector<std::pair<int, int>> edges;
  for (int i = 0; i < static_cast<int>(diagram_->instances.size()); ++i) {
    const BlockObject& object = *diagram_->instances[i].object;
    for (int s = 0; s < static_cast<int>(object.reads.size()); ++s) {
      if (!computed({i, s})) continue;
      behind(i, object.reads[s], [&](Endpoint e) { edges.emplace_back(node(e), node(i, s)); });
    }
  }
  return make_graph(nodes(), edges);
}

void Order::sort() {
  const Graph graph = reads();
  const Components components = strong_components(graph);
  std::vector<int> level(components.count, 0), order(nodes());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](int node) { return components.of[node]; });
  for (const int from : order) {
    for (int k = graph.first[from]; k < graph.first[from + 1]; ++k) {
      const int component = components.of[graph.to[k]];
      if (component == components.of[from]) continue;
      level[component] = std::max(level[component], level[components.of[from]] + 1);
    }
  }
  for (int node = 0; node < nodes(); ++node) {
    if (!computed(endpoint(node))) continue;
    level_[node] = level[components.of[node]];
    levels_ = std::max(levels_, level_[node] + 1);
  }
  find_cycles(graph, components);
}

void Order::find_cycles(const Graph& graph, const Components& components) {
  const std::vector<bool> cyclic = on_cycle(graph, components);
  std::vector<int> number(components.count, -1);
  std::vector<std::vector<int>> outputs, unsampled;
  std::vector<int> first;
  for (int node = 0; node < nodes(); ++node) {
    if (!cyclic[node]) continue;
    int& cycle = number[components.of[node]];
    if (cycle < 0) {
      cycle = static_cast<int>(cycles_.size());
      cycles_.emplace_back().level = level_[node];
      outputs.emplace_back();
      unsampled.emplace_back();
      first.push_back(node);
    }
    cycle_[node] = cycle;
    const Endpoint e = endpoint(node);
    if (spec(e.instance).slots[e.slot].kind == SlotKind::relation) {
      cycles_[cycle].relations.push_back(node);
      continue;
    }
    outputs[cycle].push_back(node);
    if (!spec(e.instance).sampled()) unsampled[cycle].push_back(node);
  }
  for (std::size_t c = 0; c < cycles_.size(); ++c) {
    cycles_[c].at_hits = knots(outputs[c]);
    cycles_[c].in_steps = knots(unsampled[c]);
    const std::vector<Endpoint> loop = loop_of(first[c]);
    cycles_[c].chain = chain_of(loop);
    cycles_[c].begins = loop.front().instance;
  }
}

/// The reads among some nodes, which are numbered by their position; ascending.
Graph Order::among(const std::vector<int>& nodes) const {
  std::vector<std::pair<int, int>> edges;
  for (int k = 0; k < static_cast<int>(nodes.size()); ++k) {
    const Endpoint e = endpoint(nodes[k]);
    behind(e.instance, diagram_->instances[e.instance].object->reads[e.slot], [&](Endpoint from) {
      const auto at = std::ranges::lower_bound(nodes, node(from));
      if (at != nodes.end() && *at == node(from)) edges.emplace_back(static_cast<int>(at - nodes.begin()), k);
    });
  }
  return make_graph(static_cast<int>(nodes.size()), edges);
}

/// Which of some nodes have a guess of their own.
std::vector<bool> Order::guessed(const std::vector<int>& nodes) const {
  std::vector<bool> result;
  for (const int node : nodes) {
    result.push_back(std::ranges::any_of(diagram_->guesses,
                                         [&](const Guess& guess) { return behind_port(guess.of) == node; }));
  }
  return result;
}

/// Untangles some outputs, as far as they read each other.
std::vector<Knot> Order::knots(const std::vector<int>& outputs) const {
  const Graph graph = among(outputs);
  const Components components = strong_components(graph);
  const std::vector<bool> cyclic = on_cycle(graph, components);
  std::vector<std::vector<int>> parts(components.count);
  for (int k = 0; k < graph.nodes(); ++k) parts[components.of[k]].push_back(outputs[k]);
  std::vector<Knot> result(parts.size());
  for (int k = 0; k < graph.nodes(); ++k) {
    const int part = components.of[k];
    if (!cyclic[k] || !result[part].members.empty()) continue;
    const Graph inner = among(parts[part]);
    const std::vector<int> tears = feedback_nodes(inner, guessed(parts[part]));
    for (const int tear : tears) result[part].tears.push_back(parts[part][tear]);
    for (const int member : sorted_nodes(inner, tears)) result[part].members.push_back(parts[part][member]);
  }
  for (std::size_t part = 0; part < parts.size(); ++part) {
    if (result[part].members.empty()) result[part].members = parts[part];
  }
  return result;
}

}  // namespace flyball
