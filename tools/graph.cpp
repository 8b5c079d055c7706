#include "studies/graph.h"

#include <fmt/format.h>

#include "studies/file.h"
#include "tools/commands.h"
#include "tools/console.h"
#include "tools/json.h"
#include "tools/model_file.h"

namespace flyball {
namespace {

namespace fs = std::filesystem;

int write_graph(const std::string& graph, const fs::path& figure) {
  if (figure.extension() == ".gv") {
    write_file(figure, graph);
    return exit_done;
  }
  const Drawing drawing = draw_graph(graph, figure, figure.extension().string().substr(1));
  if (drawing.drawn) return exit_done;
  complain(fmt::format("error: {}\n", drawing.warning));
  return exit_input_output;
}

}  // namespace

int graph_command(const GraphOptions& options) {
  const ModelFile model = load_model(options.model, options.overrides);
  complain(listing(model.diagnostics));
  if (!model.plan) {
    if (options.json) print(check_json({model}));
    return exit_model_error;
  }
  if (options.json) print(graph_json(*model.plan));
  if (options.order && !options.json) print(order_table(*model.plan));
  if (!options.output.empty()) return write_graph(graph_text(*model.plan), options.output);
  if (!options.order && !options.json) print(graph_text(*model.plan));
  return exit_done;
}

}  // namespace flyball
