#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "models/diagram.h"
#include "solvers/log.h"
#include "tools/exit_status.h"

namespace flyball {

/// Arguments that cannot be meant: exit status 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct RunOptions {
  std::string model;
  std::string output;  // CSV file; empty: none
  std::vector<Override> overrides;
  // What replaces the model's [simulation].
  std::optional<double> stop, rtol, atol, max_step, step;
  std::optional<std::uint64_t> seed;
  std::optional<Rational> log_interval;
  std::optional<std::string> method;
  EventRows event_rows = EventRows::both;
  std::vector<std::pair<std::string, std::string>> metrics;  // by name, besides the model's own
  std::vector<std::string> requirements;
  std::string junit;   // XML file; empty: none
  std::string report;  // HTML file; empty: none
  bool profile = false;
  bool json = false;
  bool quiet = false;
};

struct CheckOptions {
  std::vector<std::string> files;  // models, and results where the name ends in .csv
  std::vector<Override> overrides;
  bool units = false;
  bool json = false;
};

struct FormatOptions {
  std::vector<std::string> files;
  bool check = false;  // nothing is written
  bool json = false;
};

struct DiffOptions {
  std::string before, after;
  bool json = false;
};

struct GraphOptions {
  std::string model;
  std::string output;  // .svg, .png or .gv file; empty: the graph is printed
  std::vector<Override> overrides;
  bool order = false;
  bool json = false;
};

struct ReportOptions {
  std::string input;   // CSV file of a result
  std::string output;  // HTML file; empty: beside the input
  bool quiet = false;
};

struct BlocksOptions {
  std::string name;      // empty: all
  std::string markdown;  // folder to write the reference to; empty: none
  bool schema = false;   // print the JSON Schema of model files
  bool json = false;
};

struct FitOptions {
  std::string model;
  std::string data;                                            // CSV file
  std::vector<std::pair<std::string, std::string>> matches;    // signal, column
  std::vector<std::string> parameters;                         // names
  std::vector<std::pair<std::string, std::string>> bounds;     // name, LOWER:UPPER
  std::vector<std::pair<std::string, std::string>> starts_at;  // name, value
  std::vector<Override> overrides;
  std::string gradient = "exact";
  std::string loss = "squared";
  double loss_scale = 1.0;
  int starts = 1;
  int max_iterations = 100;
  std::string output;  // folder; empty: none
  bool json = false;
  bool quiet = false;
};

struct StudyCommandOptions {
  std::string study;
  std::string output;  // folder; empty: named after the study
  int threads = 1;
  int shard = 1, shards = 1;
  bool status = false;
  bool schema = false;  // print the JSON Schema of study files
  bool json = false;
  bool quiet = false;
};

struct MergeOptions {
  std::string output;
  std::vector<std::string> parts;
};

struct SlurmOptions {
  std::string study;
  std::string output;
  std::string program;
  int shards = 16, threads = 4;
};

// The subcommands. Each returns the exit status; FileError and UsageError are left to the caller.
int run_command(const RunOptions& options);
int check_command(const CheckOptions& options);
int format_command(const FormatOptions& options);
int diff_command(const DiffOptions& options);
int fit_command(const FitOptions& options);
int graph_command(const GraphOptions& options);
int report_command(const ReportOptions& options);
int blocks_command(const BlocksOptions& options);
int study_command(const StudyCommandOptions& options);
int merge_command(const MergeOptions& options);
int slurm_command(const SlurmOptions& options);

}  // namespace flyball
