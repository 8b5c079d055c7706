#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "studies/engine/run_study.h"
#include "studies/engine/slurm.h"
#include "studies/engine/study_metadata.h"
#include "studies/engine/write_study.h"
#include "studies/file.h"
#include "studies/fit/fit_files.h"
#include "studies/pareto/front_files.h"
#include "tools/commands.h"
#include "tools/console.h"
#include "tools/interrupt.h"
#include "tools/model_file.h"
#include "tools/progress_bar.h"
#include "tools/schema.h"

namespace flyball {
namespace {

namespace fs = std::filesystem;

/// Without --output: beside where the command is given, named after the study.
fs::path folder_of(const std::string& output, const std::string& study) {
  if (!output.empty()) return output;
  return fs::path(study).stem().string() + "-results";
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder, "cannot be created", error.value());
}

/// Nothing where it has errors, which are printed.
std::optional<Study> load_study(const std::string& file) {
  Diagnostics diagnostics(file);
  std::optional<Study> study = read_study(read_file(file), diagnostics);
  complain(listing(diagnostics.sorted()));
  return study;
}

std::string plural(std::int64_t count, const std::string& one) {
  return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

std::string status_text(const Study& study, const StudyRun& run, const StudyOptions& options) {
  std::string text = study.title.empty() ? study.file : fmt::format("{} ({})", study.title, study.file);
  if (options.shards > 1) text += fmt::format(", part {} of {}", options.shard, options.shards);
  text += fmt::format("\n  {} of {} finished", run.finished, plural(run.runs, "run"));
  if (run.failed > 0) text += fmt::format(", {} failed", run.failed);
  text += '\n';
  for (const std::string& search : run.searches) text += fmt::format("  {} is not done\n", search);
  return text;
}

/// Draws how far a study is.
class StudyBar {
 public:
  explicit StudyBar(bool enabled) : bar_(enabled) {}

  void show(const StudyProgress& progress) {
    if (progress.what != what_) {
      bar_.restart(progress.part);
      what_ = progress.what;
      begun_with_ = progress.done;
    }
    const double rate = static_cast<double>(progress.done - begun_with_) / bar_.elapsed();
    bar_.show(progress.part, progress.total == 0 ? progress.what
                                                 : fmt::format("{} of {} runs, {:.3g} a second",
                                                               progress.done, progress.total, rate));
  }

  void wipe() { bar_.wipe(); }

 private:
  ProgressBar bar_;
  std::string what_;
  std::int64_t begun_with_ = 0;
};

Searches searches_in(const Study& study, const fs::path& folder, std::vector<std::string>& warnings) {
  Searches searches;
  searches.fit = run_fit;
  searches.fitted = [&warnings, &study, folder](const FitResult& fit) {
    const auto named = std::ranges::find(study.fits, fit.name, &FitDefinition::name);
    const FitInputs inputs{study.models[named->model].file, study.title, "fit." + fit.name};
    const ResultFiles written = write_fit(fit, inputs, folder);
    warnings.insert(warnings.end(), written.warnings.begin(), written.warnings.end());
  };
  searches.front = run_pareto;
  searches.front_found = [&warnings, folder](const ParetoResult& front) {
    const ResultFiles written = write_front(front, folder / ("pareto." + front.name + ".csv"));
    warnings.insert(warnings.end(), written.warnings.begin(), written.warnings.end());
  };
  return searches;
}

std::string file_lines(const std::vector<fs::path>& files) {
  std::string text;
  for (const auto& file : files)
    text += fmt::format("{}{}\n", text.empty() ? "  files   " : "          ", file.string());
  return text;
}

/// Writes the results of a complete study and tells of them.
int finish(const Study& study, const StudyRun& run, const StudyCommandOptions& command,
           const fs::path& folder) {
  const StudyResults results = write_study(study, run, folder, command.threads);
  for (const std::string& warning : results.written.warnings) complain(fmt::format("warning: {}\n", warning));
  if (results.failed > 0)
    complain(fmt::format("warning: {} of {} failed: {} tells why\n", results.failed,
                         plural(results.runs, "run"), (folder / "runs.csv").string()));
  complain(results.violations);
  if (command.json) {
    print(read_file(folder / "study.json"));
  } else if (!command.quiet) {
    print(status_text(study, run, {}) + file_lines(results.written.files) + '\n' + results.tables);
  }
  if (!results.violations.empty()) return exit_requirement_failed;
  return results.failed == results.runs ? exit_numerical_failure : exit_done;
}

int run(const Study& study, const StudyCommandOptions& command, StudyOptions options) {
  make_folder(options.folder);
  const InterruptWatch watch;
  StudyBar bar(output_is_terminal() && error_is_terminal() && !command.quiet);
  options.cancelled = [] { return InterruptWatch::signal_number() != 0; };
  options.progress = [&](const StudyProgress& progress) { bar.show(progress); };
  std::vector<std::string> warnings;
  const StudyRun result = run_study(study, options, searches_in(study, options.folder, warnings));
  bar.wipe();
  for (const std::string& warning : warnings) complain(fmt::format("warning: {}\n", warning));
  if (result.complete() && options.shards == 1) {
    const int status = finish(study, result, command, options.folder);
    return InterruptWatch::signal_number() == 0 ? status : 128 + InterruptWatch::signal_number();
  }
  if (command.json) {
    print(status_json(result));
  } else if (!command.quiet) {
    print(status_text(study, result, options));
    if (!result.complete()) print("Interrupted; the same command goes on from here.\n");
  }
  return InterruptWatch::signal_number() == 0 ? exit_done : 128 + InterruptWatch::signal_number();
}

}  // namespace

int study_command(const StudyCommandOptions& command) {
  if (command.schema) {
    print(study_schema());
    return exit_done;
  }
  const std::optional<Study> study = load_study(command.study);
  if (!study) return exit_model_error;
  StudyOptions options;
  options.folder = folder_of(command.output, command.study);
  options.threads = command.threads;
  options.shard = command.shard;
  options.shards = command.shards;
  try {
    if (!command.status) return run(*study, command, options);
    const StudyRun status = study_status(*study, options);
    print(command.json ? status_json(status) : status_text(*study, status, options));
    return exit_done;
  } catch (const std::invalid_argument& error) {
    complain(fmt::format("{}: error: {}\n", command.study, error.what()));
    return exit_model_error;
  }
}

int merge_command(const MergeOptions& options) {
  make_folder(options.output);
  try {
    merge_studies(options.output, {options.parts.begin(), options.parts.end()});
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  return exit_done;
}

int slurm_command(const SlurmOptions& options) {
  if (!load_study(options.study)) return exit_model_error;
  SlurmJob job;
  job.study = options.study;
  job.output = folder_of(options.output, options.study);
  job.folder = fs::current_path();
  job.program = options.program;
  job.shards = options.shards;
  job.threads = options.threads;
  print(slurm_script(job));
  return exit_done;
}

}  // namespace flyball
