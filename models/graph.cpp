#include "models/graph.h"

#include <algorithm>
#include <functional>
#include <queue>

namespace flyball {
namespace {

/// One visit of Tarjan's search, with the edge at which it goes on.
struct Visit {
  int node;
  int edge;
};

class ComponentSearch {
 public:
  explicit ComponentSearch(const Graph& graph)
      : graph_(graph), found_(graph.nodes(), -1), low_(graph.nodes(), 0) {
    result_.of.assign(graph.nodes(), -1);
  }

  Components run() {
    for (int node = 0; node < graph_.nodes(); ++node) {
      if (found_[node] < 0) search(node);
    }
    // Tarjan closes a component after all that it leads to.
    for (int& component : result_.of) component = result_.count - 1 - component;
    return std::move(result_);
  }

 private:
  void search(int start) {
    open(start);
    while (!visits_.empty()) {
      Visit& visit = visits_.back();
      const int node = visit.node;
      if (visit.edge < graph_.first[node + 1]) {
        const int next = graph_.to[visit.edge++];
        if (found_[next] < 0) {
          open(next);
        } else if (result_.of[next] < 0) {
          low_[node] = std::min(low_[node], found_[next]);
        }
        continue;
      }
      visits_.pop_back();
      if (!visits_.empty()) low_[visits_.back().node] = std::min(low_[visits_.back().node], low_[node]);
      if (low_[node] == found_[node]) close(node);
    }
  }

  void open(int node) {
    found_[node] = low_[node] = count_++;
    path_.push_back(node);
    visits_.push_back({node, graph_.first[node]});
  }

  void close(int node) {
    int last = -1;
    while (last != node) {
      last = path_.back();
      path_.pop_back();
      result_.of[last] = result_.count;
    }
    ++result_.count;
  }

  const Graph& graph_;
  std::vector<int> found_;  // when the search first met a node; -1: not yet
  std::vector<int> low_;
  std::vector<int> path_;
  std::vector<Visit> visits_;
  int count_ = 0;
  Components result_;
};

/// A graph from which nodes are taken until no cycle is left.
class Thinning {
 public:
  explicit Thinning(const Graph& graph)
      : graph_(graph), into_(reversed(graph)), left_(graph.nodes(), true), in_(graph.nodes(), 0), out_(in_) {
    for (int node = 0; node < graph.nodes(); ++node) {
      for (int k = graph.first[node]; k < graph.first[node + 1]; ++k) {
        ++out_[node];
        ++in_[graph.to[k]];
      }
    }
    for (int node = 0; node < graph.nodes(); ++node) trim(node);
  }

  bool left(int node) const { return left_[node]; }

  /// -1 when no node is left.
  int busiest() const {
    int best = -1;
    for (int node = 0; node < graph_.nodes(); ++node) {
      if (left_[node] && (best < 0 || traffic(node) > traffic(best))) best = node;
    }
    return best;
  }

  void take(int node) {
    if (!left_[node]) return;
    left_[node] = false;
    for (int k = graph_.first[node]; k < graph_.first[node + 1]; ++k) --in_[graph_.to[k]];
    for (int k = into_.first[node]; k < into_.first[node + 1]; ++k) --out_[into_.to[k]];
    for (int k = graph_.first[node]; k < graph_.first[node + 1]; ++k) trim(graph_.to[k]);
    for (int k = into_.first[node]; k < into_.first[node + 1]; ++k) trim(into_.to[k]);
  }

 private:
  static Graph reversed(const Graph& graph) {
    std::vector<std::pair<int, int>> edges;
    for (int node = 0; node < graph.nodes(); ++node) {
      for (int k = graph.first[node]; k < graph.first[node + 1]; ++k) edges.emplace_back(graph.to[k], node);
    }
    return make_graph(graph.nodes(), edges);
  }

  long traffic(int node) const { return static_cast<long>(in_[node]) * out_[node]; }

  /// What has no edge in or none out is on no cycle, nor is what only such nodes lead to.
  void trim(int start) {
    std::vector<int> open{start};
    while (!open.empty()) {
      const int node = open.back();
      open.pop_back();
      if (!left_[node] || (in_[node] > 0 && out_[node] > 0)) continue;
      left_[node] = false;
      for (int k = graph_.first[node]; k < graph_.first[node + 1]; ++k) {
        --in_[graph_.to[k]];
        open.push_back(graph_.to[k]);
      }
      for (int k = into_.first[node]; k < into_.first[node + 1]; ++k) {
        --out_[into_.to[k]];
        open.push_back(into_.to[k]);
      }
    }
  }

  const Graph& graph_;
  Graph into_;
  std::vector<bool> left_;
  std::vector<int> in_, out_;  // edges from and to nodes that are left
};

}  // namespace

Graph make_graph(int nodes, const std::vector<std::pair<int, int>>& edges) {
  Graph graph;
  graph.first.assign(nodes + 1, 0);
  graph.to.resize(edges.size());
  for (const auto& [from, to] : edges) ++graph.first[from + 1];
  for (int k = 0; k < nodes; ++k) graph.first[k + 1] += graph.first[k];
  std::vector<int> fill(graph.first.begin(), graph.first.end() - 1);
  for (const auto& [from, to] : edges) graph.to[fill[from]++] = to;
  return graph;
}

Components strong_components(const Graph& graph) { return ComponentSearch(graph).run(); }

std::vector<bool> on_cycle(const Graph& graph, const Components& components) {
  std::vector<int> size(components.count, 0);
  for (const int component : components.of) ++size[component];
  std::vector<bool> result(graph.nodes());
  for (int node = 0; node < graph.nodes(); ++node) {
    const auto begin = graph.to.begin() + graph.first[node], end = graph.to.begin() + graph.first[node + 1];
    result[node] = size[components.of[node]] > 1 || std::find(begin, end, node) != end;
  }
  return result;
}

std::vector<int> feedback_nodes(const Graph& graph, const std::vector<bool>& wanted) {
  Thinning thinning(graph);
  std::vector<int> result;
  const auto take = [&](int node) {
    result.push_back(node);
    thinning.take(node);
  };
  const std::vector<bool> cyclic = on_cycle(graph, strong_components(graph));
  for (int node = 0; node < graph.nodes(); ++node) {
    if (wanted[node] && cyclic[node]) take(node);
  }
  for (int node = thinning.busiest(); node >= 0; node = thinning.busiest()) take(node);
  return result;
}

std::vector<int> sorted_nodes(const Graph& graph, const std::vector<int>& cut) {
  std::vector<bool> is_cut(graph.nodes(), false);
  for (const int node : cut) is_cut[node] = true;
  std::vector<int> waiting(graph.nodes(), 0);
  for (int node = 0; node < graph.nodes(); ++node) {
    for (int k = graph.first[node]; !is_cut[node] && k < graph.first[node + 1]; ++k) ++waiting[graph.to[k]];
  }
  std::priority_queue<int, std::vector<int>, std::greater<>> ready;
  for (int node = 0; node < graph.nodes(); ++node) {
    if (waiting[node] == 0) ready.push(node);
  }
  std::vector<int> order;
  while (!ready.empty()) {
    const int node = ready.top();
    ready.pop();
    order.push_back(node);
    for (int k = graph.first[node]; !is_cut[node] && k < graph.first[node + 1]; ++k) {
      if (--waiting[graph.to[k]] == 0) ready.push(graph.to[k]);
    }
  }
  return order;
}

}  // namespace flyball
