#include "studies/run.h"

#include <fmt/format.h>

#include <filesystem>

#include "models/language/messages.h"
#include "studies/file.h"
#include "studies/metrics/junit.h"
#include "studies/report/report_files.h"
#include "tools/commands.h"
#include "tools/console.h"
#include "tools/interrupt.h"
#include "tools/json.h"
#include "tools/model_file.h"
#include "tools/profile_report.h"
#include "tools/progress_bar.h"
#include "tools/summary.h"

namespace flyball {
namespace {

SimulationSettings settings_of(const RunOptions& options, SimulationSettings settings) {
  settings.stop = options.stop.value_or(settings.stop);
  settings.rtol = options.rtol.value_or(settings.rtol);
  settings.atol = options.atol.value_or(settings.atol);
  settings.method = options.method.value_or(settings.method);
  settings.seed = options.seed.value_or(settings.seed);
  if (options.max_step) settings.max_step = options.max_step;
  if (options.step) settings.step = options.step;
  if (options.log_interval) settings.log_interval = options.log_interval;
  return settings;
}

void require_method_that_fits(const Plan& plan, const SimulationSettings& settings) {
  if (settings.method != "discrete" || plan.layout.states() == 0) return;
  std::vector<std::string> states;
  for (int k = plan.layout.first_state; k < plan.layout.first_held; ++k) states.push_back(plan.slot_name(k));
  throw UsageError("--solver: " + message::discrete_with_states(states));
}

/// Reads what an option says; what is wrong is said with its column.
template <class T>
T asked(const std::string& option, const std::string& text, const Plan& plan) {
  try {
    return T(text, plan.columns, {});
  } catch (const TextError& error) {
    const int column = SourceText(text).position(error.offset()).column;
    throw UsageError(fmt::format("{} \"{}\", column {}: {}", option, text, column, error.what()));
  }
}

/// The model's own metrics and requirements, and those of the command line.
Criteria criteria_of(const ModelFile& model, const RunOptions& options) {
  Criteria criteria = model.criteria;
  for (const auto& [name, text] : options.metrics) {
    std::erase_if(criteria.metrics, [&](const auto& known) { return known.first == name; });
    criteria.metrics.emplace_back(name, asked<Metric>("--metric", text, *model.plan));
  }
  for (const std::string& text : options.requirements)
    criteria.requirements.emplace_back(text, asked<Requirement>("--require", text, *model.plan));
  return criteria;
}

void complain_of_failed(const RunResult& result, const std::string& model) {
  for (const RequirementResult& requirement : result.assessment.requirements) {
    if (!requirement.verdict.passed)
      complain(fmt::format("{}: requirement failed: {}: {}\n", model, requirement.name,
                           requirement.verdict.message));
  }
}

int status_of(const RunResult& result) {
  // A signal that came while the results were written counts, too.
  if (InterruptWatch::signal_number() != 0) return 128 + InterruptWatch::signal_number();
  if (result.status == RunStatus::stopped) return exit_numerical_failure;
  return result.assessment.failed() > 0 ? exit_requirement_failed : exit_done;
}

std::string file_lines(const ResultFiles& written) {
  std::string text;
  for (const auto& file : written.files) {
    text += fmt::format("{}{}\n", text.empty() ? "  files   " : "          ", file.string());
  }
  return text;
}

std::string report(const RunResult& result, const RunInputs& inputs, const RunOptions& options,
                   const ResultFiles& written) {
  std::string text = run_summary(result, inputs, options.method.has_value()) + file_lines(written);
  if (written.files.empty()) text += '\n' + final_values(result.log);
  text += assessment_tables(result.assessment);
  if (written.files.empty()) text += "\nNothing was written; --output FILE.csv keeps the results.\n";
  return text;
}

RunResult watched_run(const ModelFile& model, const RunOptions& options) {
  const SimulationSettings settings = settings_of(options, model.plan->diagram->simulation);
  require_method_that_fits(*model.plan, settings);
  ProgressBar bar(output_is_terminal() && error_is_terminal() && !options.quiet);
  LogOptions log;
  log.event_rows = options.event_rows;
  const auto run = options.profile ? profile_plan : run_plan;
  return run(model.plan, settings, log, [&](double part) {
    bar.show(part);
    return InterruptWatch::signal_number() == 0;
  });
}

}  // namespace

int run_command(const RunOptions& options) {
  const ModelFile model = load_model(options.model, options.overrides);
  complain(listing(model.diagnostics));
  if (!model.plan) {
    if (options.json) print(check_json({model}));
    return exit_model_error;
  }
  const Criteria criteria = criteria_of(model, options);
  for (const std::string& file : {options.output, options.junit, options.report}) {
    if (!file.empty()) require_writable(file);
  }

  const InterruptWatch watch;
  RunResult result = watched_run(model, options);
  result.assessment = assess(criteria, result);
  // Before the files: they may fail as well.
  if (result.status == RunStatus::stopped)
    complain(fmt::format("{}: error: {}\n", model.name, result.reason));
  const RunInputs inputs{model.name, model.text, options.overrides};
  ResultFiles written;
  if (!options.output.empty()) written = write_result(result, inputs, options.output);
  if (!options.junit.empty()) write_file(options.junit, junit_xml({{model.name, &result.assessment}}));
  if (!options.report.empty()) {
    for (const std::string& warning : write_run_report(result, inputs, options.report))
      written.warnings.push_back(warning);
  }
  for (const std::string& warning : written.warnings) complain(fmt::format("warning: {}\n", warning));
  if (options.json) {
    const auto sidecar = std::filesystem::path(options.output).replace_extension("json");
    const std::string text = written.files.empty() ? metadata_json(result, inputs) : read_file(sidecar);
    print(result.profile ? with_profile(text, *result.profile) : text);
  } else if (!options.quiet) {
    print(report(result, inputs, options, written));
    if (result.profile) print(profile_text(result));
  }
  if (result.status == RunStatus::finished) complain_of_failed(result, model.name);
  return status_of(result);
}

}  // namespace flyball
