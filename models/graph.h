#pragma once

#include <utility>
#include <vector>

namespace flyball {

/// A directed graph; the edges of node k lead to `to[first[k]]` … `to[first[k + 1] - 1]`.
struct Graph {
  std::vector<int> first, to;

  int nodes() const { return static_cast<int>(first.size()) - 1; }
};

Graph make_graph(int nodes, const std::vector<std::pair<int, int>>& edges);

/// Nodes that can all reach each other. An edge never leads to a component of a lower number.
struct Components {
  int count = 0;
  std::vector<int> of;  // of each node
};

/// Tarjan 1972, without recursion: chains of 30 000 blocks are deep.
Components strong_components(const Graph& graph);

/// Whether a node is on a cycle: it shares its component, or leads to itself.
std::vector<bool> on_cycle(const Graph& graph, const Components& components);

/// Nodes without which no cycle is left: first the `wanted` ones that are on a cycle, then greedily the one
/// with the most pairs of an edge in and an edge out, the lower number among equals.
std::vector<int> feedback_nodes(const Graph& graph, const std::vector<bool>& wanted);

/// All nodes, each after those with an edge to it, but for edges that leave a node of `cut`; lower numbers
/// first.
std::vector<int> sorted_nodes(const Graph& graph, const std::vector<int>& cut);

}  // namespace flyball
