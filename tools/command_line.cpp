#include "tools/command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <filesystem>
#include <new>
#include <sstream>
#include <thread>

#include "solvers/stepper.h"
#include "studies/file.h"
#include "studies/fit/loss.h"
#include "studies/quantity_text.h"
#include "studies/versions.h"
#include "tools/commands.h"
#include "tools/console.h"

namespace flyball {
namespace {

/// Calls `parse` and turns its complaint into one about the option.
auto checked(const std::string& option, auto&& parse) {
  try {
    return parse();
  } catch (const std::invalid_argument& error) {
    throw CLI::ValidationError(option, error.what());
  }
}

void add_overrides(CLI::App* command, std::vector<Override>& overrides) {
  const auto read = [&overrides](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      const std::size_t equals = text.find('=');
      if (equals == std::string::npos || equals == 0) {
        throw CLI::ValidationError("--set", fmt::format("expected NAME=value, found \"{}\"", text));
      }
      overrides.push_back({text.substr(0, equals), text.substr(equals + 1)});
    }
  };
  command
      ->add_option_function<std::vector<std::string>>(
          "--set", read, "A parameter, or block.parameter; the value may be an expression with units")
      ->type_name("NAME=value")
      ->allow_extra_args(false);
}

void add_positive(CLI::App* command, const std::string& option, std::optional<double>& value,
                  const std::string& unit, const std::string& doc) {
  const auto read = [=, &value](const std::string& text) {
    value = checked(option, [&] { return parse_positive(text, unit); });
  };
  command->add_option_function<std::string>(option, read, doc)->type_name(unit == "1" ? "NUMBER" : "TIME");
}

void add_solver_options(CLI::App* command, RunOptions& options) {
  add_positive(command, "--stop", options.stop, "s", "End of the run, such as 20 or \"200 ms\"");
  command->add_option("--solver", options.method, "Method of integration")
      ->check(CLI::IsMember(stepper_methods()))
      ->type_name("METHOD");
  command->add_option("--seed", options.seed, "Seed of all random numbers")->type_name("NUMBER");
  add_positive(command, "--rtol", options.rtol, "1", "Relative tolerance");
  add_positive(command, "--atol", options.atol, "1", "Absolute tolerance");
  add_positive(command, "--max-step", options.max_step, "s", "Longest step of a variable-step method");
  add_positive(command, "--step", options.step, "s", "Step of a fixed-step method");
  const auto read_interval = [&options](const std::string& text) {
    options.log_interval = checked("--log-interval", [&] { return parse_positive_exact(text, "s"); });
  };
  command
      ->add_option_function<std::string>("--log-interval", read_interval,
                                         "Time between rows, such as \"10 ms\"")
      ->type_name("TIME");
}

void add_output(CLI::App* command, RunOptions& options) {
  const auto is_csv_file = [](const std::string& name) -> std::string {
    const bool has_control = std::any_of(name.begin(), name.end(), [](unsigned char c) { return c < ' '; });
    const std::filesystem::path path(name);
    if (path.extension() == ".csv" && !has_control) return {};
    return fmt::format("expected the name of a .csv file, found \"{}\"", name);
  };
  command
      ->add_option("-o,--output", options.output,
                   "Where to write the results; .json, .gp, .svg and .png stand beside it")
      ->type_name("FILE.csv")
      ->check(is_csv_file);
  const auto read_rows = [&options](const std::string& choice) {
    options.event_rows = choice == "after"  ? EventRows::after
                         : choice == "none" ? EventRows::none
                                            : EventRows::both;
  };
  command
      ->add_option_function<std::string>(
          "--event-rows", read_rows,
          "Rows at jumps besides the asked times: before and after, after, or none")
      ->check(CLI::IsMember({"both", "after", "none"}));
}

/// Whether a name ends like that of a report.
std::string is_html_file(const std::string& name) {
  if (std::filesystem::path(name).extension() == ".html") return {};
  return fmt::format("expected the name of a .html file, found \"{}\"", name);
}

void add_criteria(CLI::App* command, RunOptions& options) {
  const auto read_metric = [&options](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      const std::size_t equals = text.find('=');
      if (equals == std::string::npos || equals == 0)
        throw CLI::ValidationError("--metric", fmt::format("expected NAME=TEXT, found \"{}\"", text));
      options.metrics.emplace_back(text.substr(0, equals), text.substr(equals + 1));
    }
  };
  command
      ->add_option_function<std::vector<std::string>>(
          "--metric", read_metric, "A number to make of the run, such as \"t=settling(y, 2 %)\"")
      ->type_name("NAME=TEXT")
      ->allow_extra_args(false);
  command
      ->add_option("--require", options.requirements,
                   "What must hold, such as \"max(y) < 5 V\"; exit status 1 where it does not")
      ->type_name("TEXT")
      ->allow_extra_args(false);
  command->add_option("--junit", options.junit, "Where to write the verdicts as JUnit XML")
      ->type_name("FILE.xml");
  command->add_option("--report", options.report, "Where to write a report of the run")
      ->type_name("FILE.html")
      ->check(is_html_file);
}

CLI::App* add_run(CLI::App& app, RunOptions& options) {
  CLI::App* command = app.add_subcommand("run", "Run a model and write its results");
  command->add_option("MODEL", options.model, "Model file")->required()->type_name("FILE");
  add_output(command, options);
  add_overrides(command, options.overrides);
  add_solver_options(command, options);
  add_criteria(command, options);
  command->add_flag("--profile", options.profile,
                    "Show time and events by block, step sizes over time, and which states limited them");
  command->add_flag("--json", options.json, "Print the summary as JSON");
  command->add_flag("-q,--quiet", options.quiet, "Print errors only");
  command->footer(
      "Example:\n"
      "  flyball run models/line_arc/arc_error_loop.toml --set K_gamma=0.8 --set 'V=400 mm/s' --output "
      "arc.csv");
  return command;
}

CLI::App* add_check(CLI::App& app, CheckOptions& options) {
  CLI::App* command =
      app.add_subcommand("check", "Check models and results, and list all that is wrong with them");
  command
      ->add_option("FILE", options.files,
                   "Model files; a .csv file is compared with what the .json beside it says of it")
      ->required()
      ->type_name("FILE");
  add_overrides(command, options.overrides);
  command->add_flag("--units", options.units, "Print the unit of every signal and parameter");
  command->add_flag("--json", options.json, "Print the findings as JSON");
  command->footer(
      "Example:\n  flyball check models/*/*.toml\n  flyball check --units models/classic/pid_servo.toml\n  "
      "flyball check result.csv");
  return command;
}

CLI::App* add_graph(CLI::App& app, GraphOptions& options) {
  CLI::App* command =
      app.add_subcommand("graph", "Draw the diagram of a model, or list its order of execution");
  command->add_option("MODEL", options.model, "Model file")->required()->type_name("FILE");
  const auto is_figure = [](const std::string& name) -> std::string {
    const auto extension = std::filesystem::path(name).extension();
    if (extension == ".svg" || extension == ".png" || extension == ".gv") return {};
    return fmt::format("expected the name of a .svg, .png or .gv file, found \"{}\"", name);
  };
  command
      ->add_option("-o,--output", options.output,
                   "The drawing, or the text for Graphviz that is else printed")
      ->type_name("FILE")
      ->check(is_figure);
  command->add_flag("--order", options.order, "Print the order of execution with the rates");
  add_overrides(command, options.overrides);
  command->add_flag("--json", options.json, "Print blocks, wires and order as JSON");
  command->footer("Example:\n  flyball graph models/classic/two_rate_loop.toml --output loop.svg");
  return command;
}

/// NAME=TEXT, as often as wanted. Where the form says [=TEXT], the text may be left out, and is NAME then.
void add_pairs(CLI::App* command, const std::string& option, const std::string& form, const std::string& doc,
               std::vector<std::pair<std::string, std::string>>& pairs) {
  const bool only_name = form.find('[') != std::string::npos;
  const auto read = [=, &pairs](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      const std::size_t equals = text.find('=');
      const bool alone = equals == std::string::npos;
      if (equals == 0 || (alone && !only_name))
        throw CLI::ValidationError(option, fmt::format("expected {}, found \"{}\"", form, text));
      pairs.emplace_back(text.substr(0, equals), alone ? text : text.substr(equals + 1));
    }
  };
  command->add_option_function<std::vector<std::string>>(option, read, doc)
      ->type_name(form)
      ->allow_extra_args(false);
}

void add_loss(CLI::App* command, FitOptions& options) {
  const auto read = [&options](const std::string& text) {
    const std::size_t colon = text.find(':');
    options.loss = text.substr(0, colon);
    if (colon != std::string::npos)
      options.loss_scale = checked("--loss", [&] { return parse_positive(text.substr(colon + 1), "any"); });
    if (std::ranges::find(Loss::names(), options.loss) == Loss::names().end())
      throw CLI::ValidationError("--loss", fmt::format("expected one of {}, found \"{}\"",
                                                       fmt::join(Loss::names(), ", "), options.loss));
  };
  command
      ->add_option_function<std::string>(
          "--loss", read,
          "What residuals cost: squared, huber, soft_l1, cauchy; SCALE is the residual where it yields")
      ->type_name("NAME[:SCALE]");
}

CLI::App* add_fit(CLI::App& app, FitOptions& options) {
  CLI::App* command = app.add_subcommand("fit", "Find parameters with which a model follows data");
  command->add_option("MODEL", options.model, "Model file")->required()->type_name("FILE");
  command->add_option("--data", options.data, "CSV file of what was measured, time first")
      ->required()
      ->type_name("FILE.csv");
  add_pairs(command, "--match", "SIGNAL[=COLUMN]",
            "A logged signal and the column of the data that it should be", options.matches);
  command->get_option("--match")->required();
  command->add_option("--parameters", options.parameters, "What to find: parameters, or block.parameter")
      ->required()
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("NAME,NAME");
  add_pairs(command, "--bounds", "NAME=LOWER:UPPER", "Where a parameter may be", options.bounds);
  add_pairs(command, "--start", "NAME=value", "Where the search begins, instead of the model's value",
            options.starts_at);
  add_overrides(command, options.overrides);
  command->add_option("--gradient", options.gradient, "exact, or numeric by central differences")
      ->check(CLI::IsMember({"exact", "numeric"}));
  add_loss(command, options);
  command->add_option("--starts", options.starts, "Begin at so many places, the first one the model's")
      ->check(CLI::Range(1, 100000))
      ->type_name("NUMBER");
  command->add_option("--max-iterations", options.max_iterations, "Of each start")
      ->check(CLI::Range(1, 100000))
      ->type_name("NUMBER");
  command->add_option("-o,--output", options.output, "Folder for the result: values, curves, figure")
      ->type_name("DIR");
  command->add_flag("--json", options.json, "Print the result as JSON");
  command->add_flag("-q,--quiet", options.quiet, "Print errors only");
  command->footer(
      "Example:\n  flyball fit models/classic/pid_servo.toml --data step.csv --match shaft=angle "
      "--parameters Kp,Kd --bounds 'Kp=0 V:50 V' --output fit");
  return command;
}

CLI::App* add_report(CLI::App& app, ReportOptions& options) {
  CLI::App* command = app.add_subcommand("report", "Make one HTML file of a result, which needs no network");
  const auto is_result = [](const std::string& name) -> std::string {
    if (std::filesystem::path(name).extension() == ".csv") return {};
    return fmt::format("expected the .csv file of a result, found \"{}\"", name);
  };
  command->add_option("RESULT", options.input, "The .csv file that a run has written")
      ->required()
      ->type_name("FILE.csv")
      ->check(is_result);
  command->add_option("-o,--output", options.output, "The report; else it stands beside the result")
      ->type_name("FILE.html")
      ->check(is_html_file);
  command->add_flag("-q,--quiet", options.quiet, "Print errors only");
  command->footer("Example:\n  flyball report result.csv --output report.html");
  return command;
}

CLI::App* add_format(CLI::App& app, FormatOptions& options) {
  CLI::App* command = app.add_subcommand("format", "Put model files into the one layout; comments stay");
  command->add_option("FILE", options.files, "Model files, rewritten in place")
      ->required()
      ->type_name("FILE");
  command->add_flag("--check", options.check, "Write nothing; exit status 1 when a file would change");
  command->add_flag("--json", options.json, "Print what changed as JSON");
  command->footer("Example:\n  flyball format --check models/*/*.toml");
  return command;
}

CLI::App* add_diff(CLI::App& app, DiffOptions& options) {
  CLI::App* command = app.add_subcommand("diff", "What differs between two models, whatever their layout");
  command->add_option("BEFORE", options.before, "Model file")->required()->type_name("FILE");
  command->add_option("AFTER", options.after, "Model file")->required()->type_name("FILE");
  command->add_flag("--json", options.json, "Print the differences as JSON");
  command->footer("Exit status 1 when the models differ.\n\nExample:\n  flyball diff before.toml after.toml");
  return command;
}

CLI::App* add_blocks(CLI::App& app, BlocksOptions& options) {
  CLI::App* command = app.add_subcommand("blocks", "List the blocks, or show the reference page of one");
  command->add_option("NAME", options.name, "Block type")->type_name("NAME");
  command->add_option("--markdown", options.markdown, "Write the whole reference, a page a block")
      ->type_name("DIR");
  command->add_flag("--schema", options.schema, "Print the JSON Schema of model files, for editors");
  command->add_flag("--json", options.json, "Print the declarations as JSON");
  command->footer("Example:\n  flyball blocks PID");
  return command;
}

void add_merge(CLI::App& study, MergeOptions& options) {
  CLI::App* command = study.add_subcommand("merge", "Join the parts of a study that --shard ran");
  command->add_option("OUTPUT", options.output, "Folder of the whole study")->required()->type_name("DIR");
  command->add_option("PART", options.parts, "Folders of its parts")->required()->type_name("DIR");
  command->footer(
      "What is there stays. Then the study itself writes the tables, and runs what is missing.\n\nExample:\n"
      "  flyball study merge results part-1 part-2\n  flyball study motor.toml --output results");
}

void add_slurm(CLI::App& study, SlurmOptions& options) {
  CLI::App* command = study.add_subcommand("slurm", "Print a script that runs a study as an array of jobs");
  command->add_option("STUDY", options.study, "Study file")->required()->type_name("FILE");
  command->add_option("-o,--output", options.output, "Folder of the whole study")->type_name("DIR");
  command->add_option("--shards", options.shards, "Parts, a job each")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--threads", options.threads, "Threads of a job")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--program", options.program, "Where the jobs find this program")
      ->capture_default_str();
  command->footer("Example:\n  flyball study slurm motor.toml --shards 32 >job.sh");
}

/// "2/8"
void read_shard(const std::string& text, StudyCommandOptions& options) {
  const char *at = text.data(), *end = text.data() + text.size();
  const auto first = std::from_chars(at, end, options.shard);
  const bool split = first.ptr != at && first.ptr != end && *first.ptr == '/';
  const auto second = split ? std::from_chars(first.ptr + 1, end, options.shards) : first;
  if (split && second.ec == std::errc() && second.ptr == end && options.shard >= 1 &&
      options.shard <= options.shards) {
    return;
  }
  throw CLI::ValidationError("--shard", fmt::format("expected a part such as 2/8, found \"{}\"", text));
}

CLI::App* add_study(CLI::App& app, StudyCommandOptions& options) {
  CLI::App* command = app.add_subcommand("study", "Do what a study file holds: compare, sweep, sample, fit");
  command->add_option("STUDY", options.study, "Study file")->type_name("FILE");
  command->add_option("-o,--output", options.output, "Folder of all results; without it, STUDY-results here")
      ->type_name("DIR");
  options.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  command->add_option("--threads", options.threads, "Threads; without it, all that the machine has")
      ->check(CLI::PositiveNumber)
      ->type_name("NUMBER");
  command
      ->add_option_function<std::string>(
          "--shard", [&options](const std::string& text) { read_shard(text, options); },
          "Run one of several equal parts only; join them with \"study merge\"")
      ->type_name("K/N");
  command->add_flag("--status", options.status, "Tell what is finished, and do nothing");
  command->add_flag("--schema", options.schema, "Print the JSON Schema of study files, for editors");
  command->add_flag("--json", options.json, "Print the outcome as JSON");
  command->add_flag("-q,--quiet", options.quiet, "Print errors only");
  command->require_subcommand(0, 1);
  command->footer(
      "A study that was interrupted, or killed, goes on when the same command is given again.\nExit status 1 "
      "when "
      "a requirement does not hold.\n\nExample:\n  flyball study studies/classic/pid_tuning.toml --output "
      "results");
  return command;
}

/// CLI11 writes help and errors to the streams that it is given.
int explain(const CLI::App& app, const CLI::ParseError& error) {
  std::ostringstream out, err;
  const int status = app.exit(error, out, err);
  print(out.str());
  complain(err.str());
  return status == 0 ? exit_done : exit_usage;
}

int parse_and_run(int argc, const char* const* argv) {
  CLI::App app("Flyball simulates block diagrams that are written as text.", "flyball");
  RunOptions run;
  CheckOptions check;
  GraphOptions graph;
  FitOptions fit;
  ReportOptions report;
  FormatOptions format;
  DiffOptions diff;
  BlocksOptions blocks;
  StudyCommandOptions study;
  MergeOptions merge;
  SlurmOptions slurm;
  slurm.program = argv[0];
  const CLI::App* run_app = add_run(app, run);
  const CLI::App* check_app = add_check(app, check);
  const CLI::App* graph_app = add_graph(app, graph);
  const CLI::App* fit_app = add_fit(app, fit);
  const CLI::App* report_app = add_report(app, report);
  const CLI::App* format_app = add_format(app, format);
  const CLI::App* diff_app = add_diff(app, diff);
  add_blocks(app, blocks);
  CLI::App* study_app = add_study(app, study);
  add_merge(*study_app, merge);
  add_slurm(*study_app, slurm);
  app.set_version_flag("--version", "flyball " + flyball_version());
  app.require_subcommand(1);
  app.footer("Example:\n  flyball run MODEL.toml --output result.csv\n\nflyball COMMAND --help tells more.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return explain(app, error);
  }
  if (run_app->parsed()) return run_command(run);
  if (check_app->parsed()) return check_command(check);
  if (graph_app->parsed()) return graph_command(graph);
  if (fit_app->parsed()) return fit_command(fit);
  if (report_app->parsed()) return report_command(report);
  if (format_app->parsed()) return format_command(format);
  if (diff_app->parsed()) return diff_command(diff);
  if (study_app->got_subcommand("merge")) return merge_command(merge);
  if (study_app->got_subcommand("slurm")) return slurm_command(slurm);
  if (study_app->parsed()) {
    if (study.study.empty() && !study.schema)
      throw UsageError("flyball study: expected the name of a study file");
    return study_command(study);
  }
  return blocks_command(blocks);
}

}  // namespace

int run_command_line(int argc, const char* const* argv) {
  reserve_standard_streams();
  const auto fail = [](std::string_view message, ExitStatus status) {
    complain(fmt::format("error: {}\n", message));
    return static_cast<int>(status);
  };
  try {
    return parse_and_run(argc, argv);
  } catch (const UsageError& error) {
    return fail(error.what(), exit_usage);
  } catch (const FileError& error) {
    return fail(error.what(), exit_input_output);
  } catch (const std::bad_alloc&) {
    return fail("out of memory", exit_numerical_failure);
  } catch (const std::length_error&) {
    return fail("the results have more rows than fit memory: log at longer intervals",
                exit_numerical_failure);
  }
}

}  // namespace flyball
