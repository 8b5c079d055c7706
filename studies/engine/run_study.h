#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "studies/engine/store.h"
#include "studies/fit/fit.h"
#include "studies/language/run_table.h"
#include "studies/pareto/pareto.h"

namespace flyball {

/// What looks for settings of cases, and what is done with what it finds, before anything else happens.
struct Searches {
  decltype(&run_fit) fit = nullptr;
  decltype(&run_pareto) front = nullptr;
  std::function<void(const FitResult&)> fitted = {};
  std::function<void(const ParetoResult&)> front_found = {};
};

/// How far a study is.
struct StudyProgress {
  std::string what;  // "runs", "fit.reference", "pareto.gains"
  double part = 0.0;
  std::int64_t done = 0, total = 0;  // of runs
};

struct StudyOptions {
  std::filesystem::path folder;  // of all results; it is there
  int threads = 1;
  int shard = 1, shards = 1;  // of `shards` parts this one, from 1 on
  std::function<bool()> cancelled = {};
  std::function<void(const StudyProgress&)> progress = {};
};

struct StudyRun {
  std::vector<Choice> cases;          // with what was found for them
  std::vector<std::string> searches;  // that are not done: "fit.reference"; the runs wait for them
  std::int64_t runs = 0;              // of this part
  std::int64_t finished = 0;          // of them, those that failed included
  std::int64_t found = 0;             // of them, those that were there at the start
  std::int64_t failed = 0;            // in the folder
  bool interrupted = false;

  bool complete() const { return searches.empty() && finished == runs; }
};

/// The file in a study's folder that keeps its runs.
std::filesystem::path store_file(const std::filesystem::path& folder);
StoreColumns store_columns(const Study& study);

/// Does what is missing of a study, or of a part of it: searches first, then runs. Everything that is
/// finished is kept at once. Throws OutputError, and std::invalid_argument where a search cannot begin.
StudyRun run_study(const Study& study, const StudyOptions& options, const Searches& searches);

/// The same without doing anything: what is there.
StudyRun study_status(const Study& study, const StudyOptions& options);

/// Adds the runs of the stores in other folders to that of `folder`. Throws std::invalid_argument where they
/// are not of one study.
void merge_studies(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& others);

}  // namespace flyball
