#include "studies/fit/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <thread>

#include "studies/file.h"
#include "studies/fit/fit_files.h"
#include "studies/parameter_unit.h"
#include "tools/commands.h"
#include "tools/console.h"
#include "tools/fit_summary.h"
#include "tools/interrupt.h"
#include "tools/json.h"
#include "tools/model_file.h"
#include "tools/quantity_argument.h"

namespace flyball {
namespace {

namespace fs = std::filesystem;

/// The parameters of --parameters, with what --bounds and --start say of them in their units.
class SoughtReader {
 public:
  SoughtReader(const FitOptions& options, const Plan& plan) : options_(options), plan_(plan) {}

  std::vector<Sought> read() {
    for (const std::string& name : options_.parameters) {
      Sought one;
      one.name = name;
      one.lower = -std::numeric_limits<double>::infinity();
      one.upper = std::numeric_limits<double>::infinity();
      sought_.push_back(std::move(one));
    }
    for (const auto& [name, text] : options_.bounds) read_bounds(find("--bounds", name), text);
    for (const auto& [name, text] : options_.starts_at)
      find("--start", name).start = value("--start", name, text);
    return std::move(sought_);
  }

 private:
  Sought& find(const std::string& option, const std::string& name) {
    const auto found = std::ranges::find(sought_, name, &Sought::name);
    if (found == sought_.end())
      throw UsageError(fmt::format("{}: {} is not one of --parameters", option, name));
    return *found;
  }

  double value(const std::string& option, const std::string& name, const std::string& text) const {
    const std::string unit = parameter_unit(plan_, name);
    try {
      return parse_quantity(text, unit.empty() ? "any" : unit);
    } catch (const UsageError& error) {
      throw UsageError(fmt::format("{}: {}: {}", option, name, error.what()));
    }
  }

  /// LOWER:UPPER, where either may be left out.
  void read_bounds(Sought& sought, const std::string& text) const {
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos) {
      throw UsageError(
          fmt::format("--bounds: {}: expected LOWER:UPPER, such as 0:50, found \"{}\"", sought.name, text));
    }
    const std::string lower = text.substr(0, colon), upper = text.substr(colon + 1);
    if (!lower.empty()) sought.lower = value("--bounds", sought.name, lower);
    if (!upper.empty()) sought.upper = value("--bounds", sought.name, upper);
  }

  const FitOptions& options_;
  const Plan& plan_;
  std::vector<Sought> sought_;
};

FitDefinition definition_of(const FitOptions& options, const Plan& plan) {
  FitDefinition fit;
  fit.name = "fitted";
  fit.parameters = SoughtReader(options, plan).read();
  FitExperiment experiment;
  experiment.name = fs::path(options.data).stem().string();
  experiment.data = options.data;
  for (const auto& [signal, column] : options.matches) experiment.matches.push_back({signal, column, 1.0});
  fit.experiments.push_back(std::move(experiment));
  fit.gradient = options.gradient;
  fit.loss = options.loss;
  fit.loss_scale = options.loss_scale;
  fit.starts = options.starts;
  fit.max_iterations = options.max_iterations;
  return fit;
}

void require_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder, "cannot be created", error.value());
  require_writable(folder / "fit.json");
}

FitResult watched_fit(const Study& study, const FitDefinition& fit, bool shows) {
  Evaluator evaluator(study.models);
  const auto threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  return run_fit(study, fit, evaluator, threads, [&](int iteration, double cost) {
    if (shows) complain(fmt::format("iteration {:3}  cost {:.6g}\n", iteration, cost));
    return InterruptWatch::signal_number() == 0;
  });
}

int status_of(const FitResult& result) {
  if (InterruptWatch::signal_number() != 0) return 128 + InterruptWatch::signal_number();
  return result.converged ? exit_done : exit_numerical_failure;
}

}  // namespace

int fit_command(const FitOptions& options) {
  ModelFile model = load_model(options.model, options.overrides);
  complain(listing(model.diagnostics));
  if (!model.plan) {
    if (options.json) print(check_json({model}));
    return exit_model_error;
  }
  if (!options.output.empty()) require_folder(options.output);
  Study study;
  const std::string title = model.plan->diagram->title;
  study.models.push_back({fs::path(model.name).stem().string(), model.name, model.text, model.plan, {}, {}});

  const InterruptWatch watch;
  FitResult result;
  try {
    const bool shows = error_is_terminal() && !options.quiet && !options.json;
    result = watched_fit(study, definition_of(options, *model.plan), shows);
  } catch (const FitError& error) {
    complain(fmt::format("{}\n", error.what()));
    return exit_model_error;
  }
  const FitInputs inputs{model.name, title.empty() ? study.models[0].name : title, "fit"};
  ResultFiles written;
  if (!options.output.empty()) written = write_fit(result, inputs, options.output);
  for (const std::string& warning : written.warnings) complain(fmt::format("warning: {}\n", warning));
  if (options.json) {
    print(fit_json(result, inputs));
  } else if (!options.quiet) {
    print(fit_summary(result, inputs, written.files));
  }
  if (!result.converged) complain(fmt::format("{}: error: no fit: {}\n", model.name, result.reason));
  return status_of(result);
}

}  // namespace flyball
