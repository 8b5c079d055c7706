#include "studies/report/model_of_result.h"

#include <algorithm>

#include "models/read_file.h"
#include "studies/file.h"
#include "studies/graph.h"
#include "studies/metadata.h"

namespace flyball {
namespace {

constexpr std::size_t most_blocks = 300;

}  // namespace

UnchangedModel find_model(const std::string& file, const std::string& hash,
                          const std::vector<Override>& overrides) {
  const auto text = read_file_content(file);
  if (!text) return {};
  Diagnostics diagnostics(file);
  auto diagram = read_diagram(*text, diagnostics, overrides);
  if (!diagram || model_fingerprint(*text, *diagram) != hash) return {};
  return {*text, make_plan(std::make_shared<const Diagram>(*std::move(diagram)), diagnostics)};
}

std::string drawn_diagram(const Plan& plan, const std::filesystem::path& beside,
                          std::vector<std::string>& warnings) {
  if (plan.diagram->instances.size() > most_blocks) return {};
  const TemporaryFile file(beside);
  const Drawing drawing = draw_graph(graph_text(plan), file.path(), "svg");
  if (!drawing.drawn) {
    warnings.push_back(drawing.warning);
    return {};
  }
  // Without the prolog of a file of its own.
  const std::string svg = read_file(file.path());
  return svg.substr(std::min(svg.find("<svg"), svg.size()));
}

}  // namespace flyball
