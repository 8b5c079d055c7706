#include "studies/report/report_files.h"

#include "models/language/csv.h"
#include "studies/file.h"
#include "studies/report/model_of_result.h"

namespace flyball {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> write(RunReportSources sources, const fs::path& html) {
  std::vector<std::string> warnings;
  if (sources.plan != nullptr) sources.diagram_svg = drawn_diagram(*sources.plan, html, warnings);
  write_file(html, to_html(run_page(sources)));
  return warnings;
}

}  // namespace

std::vector<std::string> write_run_report(const RunResult& result, const RunInputs& inputs,
                                          const fs::path& html) {
  return write({read_result_facts(metadata_json(result, inputs)),
                curves_of(result.log),
                inputs.model_text,
                result.plan,
                {}},
               html);
}

std::vector<std::string> write_result_report(const fs::path& csv, const fs::path& html) {
  RunReportSources sources;
  sources.facts = read_result_facts(read_file(fs::path(csv).replace_extension("json")));
  Diagnostics diagnostics(csv.string());
  const auto table = read_csv(read_file(csv), diagnostics);
  if (!table || table->width() != static_cast<int>(sources.facts.columns.size()) + 1)
    throw MetadataError("the CSV file is not the result of its metadata");
  sources.curves.values.resize(sources.facts.columns.size());
  for (int row = 0; row < table->rows(); ++row) {
    sources.curves.time.push_back(table->at(row, 0));
    for (int c = 1; c < table->width(); ++c)
      sources.curves.values[static_cast<std::size_t>(c) - 1].push_back(table->at(row, c));
  }
  const UnchangedModel model =
      find_model(sources.facts.model_file, sources.facts.model_hash, sources.facts.overrides);
  sources.model_text = model.text;
  sources.plan = model.plan;
  return write(std::move(sources), html);
}

}  // namespace flyball
