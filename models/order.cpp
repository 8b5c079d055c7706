#include "models/order.h"

#include <fmt/format.h>

#include <algorithm>

namespace flyball {

Order::Order(const Diagram& diagram) : diagram_(&diagram) {
  base_.push_back(0);
  for (const Instance& instance : diagram.instances) {
    base_.push_back(base_.back() + static_cast<int>(instance.object->specification->slots.size()));
  }
  source_.resize(nodes());
  level_.assign(nodes(), -1);
}

std::optional<Order> Order::of(const Diagram& diagram, Diagnostics& diagnostics) {
  Order order(diagram);
  const int before = diagnostics.errors();
  order.resolve_sources(diagnostics);
  if (diagnostics.errors() > before) return std::nullopt;
  if (!order.sort()) {
    order.report_loop(diagnostics);
    return std::nullopt;
  }
  return order;
}

Endpoint Order::endpoint(int node) const {
  const auto after = std::ranges::upper_bound(base_, node);
  const int instance = static_cast<int>(after - base_.begin()) - 1;
  return {instance, node - base_[instance]};
}

bool Order::evaluated(Endpoint e) const {
  const SlotKind kind = spec(e.instance).slots[e.slot].kind;
  return kind == SlotKind::output || kind == SlotKind::object_output || kind == SlotKind::relation;
}

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

bool Order::sort() {
  std::vector<int> waiting(nodes(), 0), first(nodes() + 1, 0), after;
  std::vector<std::pair<int, int>> edges;  // from, to
  std::vector<int> ready;
  int left = 0;
  for (int i = 0; i < static_cast<int>(diagram_->instances.size()); ++i) {
    const BlockObject& object = *diagram_->instances[i].object;
    for (int s = 0; s < static_cast<int>(object.reads.size()); ++s) {
      if (!evaluated({i, s}) || source_[node(i, s)].connected()) continue;
      ++left;
      behind(i, object.reads[s], [&](Endpoint e) {
        edges.emplace_back(node(e), node(i, s));
        ++waiting[node(i, s)];
      });
      if (waiting[node(i, s)] == 0) ready.push_back(node(i, s));
    }
  }
  for (const auto& [from, to] : edges) ++first[from + 1];
  for (int k = 0; k < nodes(); ++k) first[k + 1] += first[k];
  after.resize(edges.size());
  std::vector<int> fill(first.begin(), first.end() - 1);
  for (const auto& [from, to] : edges) after[fill[from]++] = to;
  for (levels_ = 0; !ready.empty(); ++levels_) {
    std::vector<int> next;
    for (const int at : ready) {
      level_[at] = levels_;
      --left;
      for (int k = first[at]; k < first[at + 1]; ++k) {
        if (--waiting[after[k]] == 0) next.push_back(after[k]);
      }
    }
    ready = std::move(next);
  }
  return left == 0;
}

std::vector<Endpoint> Order::find_loop() const {
  const auto unsorted = [&](Endpoint e) {
    return evaluated(e) && !source_[node(e)].connected() && level_[node(e)] < 0;
  };
  Endpoint at;
  for (int k = 0; k < nodes() && !at.connected(); ++k) {
    if (unsorted(endpoint(k))) at = endpoint(k);
  }
  // Every unsorted node has an unsorted one behind it, so walking back must meet itself.
  std::vector<int> seen(nodes(), -1);
  std::vector<Endpoint> walk;
  while (seen[node(at)] < 0) {
    seen[node(at)] = static_cast<int>(walk.size());
    walk.push_back(at);
    Endpoint before;
    behind(at.instance, diagram_->instances[at.instance].object->reads[at.slot], [&](Endpoint e) {
      if (!before.connected() && unsorted(e)) before = e;
    });
    at = before;
  }
  walk.erase(walk.begin(), walk.begin() + seen[node(at)]);
  std::ranges::reverse(walk);
  // Begin with the block that stands first in the file.
  const auto first =
      std::ranges::min_element(walk, {}, [&](Endpoint e) { return diagram_->instances[e.instance].at; });
  std::ranges::rotate(walk, first);
  return walk;
}

void Order::report_loop(Diagnostics& diagnostics) const {
  const std::vector<Endpoint> loop = find_loop();
  const auto name = [&](Endpoint e) {
    return fmt::format("{}.{}", diagram_->instances[e.instance].name, spec(e.instance).slots[e.slot].name);
  };
  std::string chain = name(loop.front());
  for (std::size_t k = 1; k <= loop.size(); ++k) {
    const Endpoint from = loop[k - 1], to = loop[k % loop.size()];
    for (int s = 0; s < static_cast<int>(spec(to.instance).slots.size()); ++s) {
      const bool reads =
          std::ranges::binary_search(diagram_->instances[to.instance].object->reads[to.slot], s);
      if (reads && source_[node(to.instance, s)] == from) {
        chain += fmt::format(" -> {}", name({to.instance, s}));
        break;
      }
    }
    chain += fmt::format(" -> {}", name(to));
  }
  const Instance& begin = diagram_->instances[loop.front().instance];
  diagnostics.error(begin.at, fmt::format("algebraic loop: {}", chain));
  diagnostics.note(
      begin.at,
      "each of these needs the next one at the same time; an Integrator, a strictly proper TransferFcn "
      "or a UnitDelay anywhere in the chain breaks it");
}

}  // namespace flyball
