#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "models/plan.h"
#include "studies/drawing.h"

namespace flyball {

/// The diagram in the language of Graphviz: blocks filled by family and framed by rate, wires coloured by the
/// rate at which they change, subsystems as boxes, and a legend of what occurs.
std::string graph_text(const Plan& plan);

struct ExecutionStep {
  int instance;
  std::string computes;  // "outputs" or "relations"
};

/// What is computed at an instant, in order.
std::vector<ExecutionStep> execution_order(const Plan& plan);
/// The same as a table, with the rate of each block.
std::string order_table(const Plan& plan);

/// "continuous", or the sample time of a block with its offset: "10 ms", "10 ms + 2 ms".
std::string rate_name(const Plan& plan, int instance);

/// Draws a graph with Graphviz and puts the figure in place whole or not at all; `format` is "svg" or "png".
/// Throws OutputError.
Drawing draw_graph(const std::string& graph, const std::filesystem::path& figure, const std::string& format);

}  // namespace flyball
