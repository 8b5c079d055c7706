#include "studies/run.h"

#include <fmt/format.h>

#include <filesystem>

#include "models/language/messages.h"
#include "studies/file.h"
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

int status_of(const RunResult& result) {
  // A signal that came while the results were written counts, too.
  if (InterruptWatch::signal_number() != 0) return 128 + InterruptWatch::signal_number();
  return result.status == RunStatus::stopped ? exit_numerical_failure : exit_done;
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
  if (!written.files.empty()) return text;
  return text + '\n' + final_values(result.log) +
         "\nNothing was written; --output FILE.csv keeps the results.\n";
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
  if (!options.output.empty()) require_writable(options.output);

  const InterruptWatch watch;
  const RunResult result = watched_run(model, options);
  // Before the files: they may fail as well.
  if (result.status == RunStatus::stopped)
    complain(fmt::format("{}: error: {}\n", model.name, result.reason));
  const RunInputs inputs{model.name, model.text, options.overrides};
  ResultFiles written;
  if (!options.output.empty()) written = write_result(result, inputs, options.output);
  for (const std::string& warning : written.warnings) complain(fmt::format("warning: {}\n", warning));
  if (options.json) {
    const auto sidecar = std::filesystem::path(options.output).replace_extension("json");
    const std::string text = written.files.empty() ? metadata_json(result, inputs) : read_file(sidecar);
    print(result.profile ? with_profile(text, *result.profile) : text);
  } else if (!options.quiet) {
    print(report(result, inputs, options, written));
    if (result.profile) print(profile_text(result));
  }
  return status_of(result);
}

}  // namespace flyball
