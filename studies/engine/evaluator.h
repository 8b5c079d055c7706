#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "blocks/isa.h"
#include "studies/language/study.h"
#include "studies/run.h"

namespace flyball {

/// A run that is wanted: a model with these settings (later ones win) and this seed of its noise.
struct RunRequest {
  int model = 0;
  std::vector<Setting> settings;
  std::uint64_t seed = 1;
};

/// What is kept of a run.
struct RunRecord {
  RunStatus status = RunStatus::finished;
  std::string reason;             // where it was stopped, or could not be built
  double end = 0.0;               // simulated time that was reached [s]
  std::vector<double> metrics;    // of StudyModel::metrics; NaN where the run was stopped
  std::vector<Verdict> verdicts;  // of StudyModel::requirements
  std::optional<Log> log;         // where it was asked for
};

struct EvaluatorOptions {
  int threads = 1;
  bool keep_logs = false;
  /// Called with results as they come, in any order but one at a time: number of the request and its record.
  std::function<void(std::size_t, const RunRecord&)> done = {};
  /// Looked at between runs: true ends the work early; what has not run is RunStatus::interrupted.
  std::function<bool()> cancelled = {};
};

/// Neighbours go in groups of this size, in lockstep where their plan allows it: a run takes the steps of its
/// group, so its record depends on the group, and on nothing else.
inline constexpr int group_size = lane_count;

/// The records of group `number`.
struct FinishedGroup {
  std::int64_t number = 0;
  std::vector<RunRecord> records;
};

/// The runs of a group, at most `group_size`; called from several threads at once.
using GroupSource = std::function<std::vector<RunRequest>(std::int64_t)>;
/// Takes groups as they come, in any order but one call at a time.
using GroupSink = std::function<void(std::vector<FinishedGroup>&)>;

/// Carries out runs of a study's models on one plan for each structure, in lanes where the plan allows it.
/// The same requests give the same records with any number of threads.
class Evaluator {
 public:
  /// The models must outlive it.
  explicit Evaluator(const std::vector<StudyModel>& models);
  ~Evaluator();

  /// A run that fails is a record with its reason, never an exception. Requests 4g to 4g + 3 are group g.
  std::vector<RunRecord> run(std::span<const RunRequest> requests, const EvaluatorOptions& options = {});

  /// The same for groups 0, 1, … of any number: none of their records is kept. A group that was cancelled is
  /// left out as a whole. Rethrows what `sink` throws.
  void run_groups(std::int64_t groups, const GroupSource& source, const GroupSink& sink,
                  const EvaluatorOptions& options = {});

  /// The plan of a model with settings that are texts; throws std::invalid_argument with what is wrong.
  std::shared_ptr<const Plan> plan(int model, std::span<const Setting> settings);

 private:
  struct Plans;
  std::unique_ptr<Plans> plans_;
};

}  // namespace flyball
