#include "studies/engine/write_study.h"

#include "studies/engine/bisect_table.h"
#include "studies/engine/comparison.h"
#include "studies/engine/plots.h"
#include "studies/engine/runs_csv.h"
#include "studies/engine/study_metadata.h"
#include "studies/engine/summary.h"
#include "studies/file.h"

namespace flyball {

namespace fs = std::filesystem;

StudyResults write_study(const Study& study, const StudyRun& run, const fs::path& folder, int threads) {
  const RunTable table(study, run.cases);
  const Store store(store_file(folder), Store::Mode::read);
  const StudyData data{study, table, store};
  StudyResults results;
  results.runs = table.size();
  results.failed = store.count(RunStatus::stopped);
  std::vector<fs::path>& files = results.written.files;
  const auto write = [&](const char* name, auto&& content) {
    content(folder / name);
    files.push_back(folder / name);
  };
  write("runs.csv", [&](const fs::path& file) { write_runs_csv(data, file); });
  if (!study.metrics.empty()) {
    write("summary.csv", [&](const fs::path& file) { write_summary_csv(data, file); });
    results.tables += summary_text(data);
  }
  if (can_compare(study)) {
    write("comparison.csv", [&](const fs::path& file) { write_comparison_csv(data, file); });
    results.tables += '\n' + comparison_text(data);
  }
  const std::vector<RequirementSummary> requirements = summarise_requirements(data);
  if (!requirements.empty()) {
    write("requirements.csv",
          [&](const fs::path& file) { write_file(file, requirements_csv(requirements)); });
    results.tables += '\n' + requirements_text(data, requirements);
    results.violations = violations(data, requirements);
  }
  Evaluator evaluator(study.models);
  if (!study.bisections.empty()) {
    std::vector<BisectResult> limits;
    EvaluatorOptions options;
    options.threads = threads;
    for (const BisectDefinition& bisection : study.bisections)
      limits.push_back(run_bisect(study, bisection, run.cases, evaluator, options));
    write("bisections.csv", [&](const fs::path& file) { write_file(file, bisections_csv(study, limits)); });
    results.tables += '\n' + bisections_text(study, limits);
  }
  if (!study.plots.empty()) {
    const ResultFiles plots = write_plots(data, evaluator, folder);
    files.insert(files.end(), plots.files.begin(), plots.files.end());
    results.written.warnings = plots.warnings;
  }
  const std::string json = study_json(data, run.cases, requirements, files);
  write("study.json", [&](const fs::path& file) { write_file(file, json); });
  return results;
}

}  // namespace flyball
