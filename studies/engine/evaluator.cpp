#include "studies/engine/evaluator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "solvers/lane_simulator.h"
#include "solvers/parallel.h"
#include "studies/engine/delivery.h"
#include "studies/engine/run_setup.h"

namespace flyball {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// What the metrics and requirements of a model ask of its runs.
struct Wishes {
  bool log = false;
  bool end_row = false;

  Wishes(const StudyModel& model, bool keep_log) {
    const auto reads_end = [](const auto& question) { return question.reads_end_only(); };
    log = keep_log || !std::ranges::all_of(model.metrics, reads_end) ||
          !std::ranges::all_of(model.requirements, reads_end);
    end_row = !model.metrics.empty() || !model.requirements.empty();
  }
};

/// What is kept of a run that gave no numbers.
RunRecord failure(const StudyModel& model, std::string reason) {
  RunRecord record;
  record.status = RunStatus::stopped;
  record.metrics.assign(model.metrics.size(), not_a_number);
  record.verdicts.assign(model.requirements.size(),
                         {false, not_a_number, not_a_number, not_a_number, reason});
  record.reason = std::move(reason);
  return record;
}

/// There are several bit patterns of NaN, and which one comes out is the compiler's choice.
double with_one_nan(double x) { return std::isnan(x) ? not_a_number : x; }

RunRecord record_of(const StudyModel& model, const LaneOutcome& outcome) {
  RunRecord record;
  if (!outcome.error.empty()) {
    record = failure(model, outcome.error);
  } else {
    record.reason = outcome.end_reason;
    for (const Metric& metric : model.metrics)
      record.metrics.push_back(with_one_nan(metric.evaluate(*outcome.log, outcome.statistics)));
    for (const Requirement& requirement : model.requirements) {
      Verdict verdict = requirement.check(*outcome.log, outcome.statistics);
      for (double* x : {&verdict.margin, &verdict.value, &verdict.time}) *x = with_one_nan(*x);
      record.verdicts.push_back(std::move(verdict));
    }
  }
  record.end = outcome.end;
  return record;
}

/// Carries out groups of runs in one thread.
class Worker {
 public:
  Worker(const std::vector<StudyModel>& models, Setups& setups, const EvaluatorOptions& options)
      : models_(models), setups_(setups), options_(options) {}

  /// Nothing where the work was cancelled.
  std::optional<std::vector<RunRecord>> run(std::span<const RunRequest> group) {
    std::vector<RunRecord> records(group.size());
    for (Part& part : parts_of(group, records)) {
      std::vector<LaneOutcome> outcomes = run(part);
      for (std::size_t k = 0; k < outcomes.size(); ++k) {
        if (outcomes[k].cancelled) return std::nullopt;
        RunRecord& record = records[part.members[k]];
        record = record_of(models_[part.model], outcomes[k]);
        if (options_.keep_logs) record.log = std::move(outcomes[k].log);
      }
    }
    return records;
  }

 private:
  /// Runs of a group that may go in lockstep: they differ in numbers alone.
  struct Part {
    int model = 0;
    RunSetup setup;
    std::vector<LaneInput> inputs;
    std::vector<std::size_t> members;  // of the group
  };

  /// Runs that cannot begin get their records at once.
  std::vector<Part> parts_of(std::span<const RunRequest> group, std::vector<RunRecord>& records) {
    std::vector<Part> parts;
    for (std::size_t k = 0; k < group.size(); ++k) {
      try {
        RunSetup setup = setups_.make(group[k].model, group[k].settings);
        LaneInput input{std::move(setup.parameters), group[k].seed};
        const auto same = [&](const Part& part) { return part.setup.form == setup.form; };
        auto part = std::ranges::find_if(parts, same);
        if (part == parts.end()) part = parts.insert(part, {group[k].model, std::move(setup), {}, {}});
        part->inputs.push_back(std::move(input));
        part->members.push_back(k);
      } catch (const std::invalid_argument& error) {
        records[k] = failure(models_[group[k].model], error.what());
      }
    }
    return parts;
  }

  std::vector<LaneOutcome> run(const Part& part) {
    LaneSimulator& simulator = simulator_of(part);
    // Four lanes cost more than one run alone.
    if (part.inputs.size() == 1) return {simulator.run_alone(part.inputs[0])};
    return simulator.run(part.inputs);
  }

  LaneSimulator& simulator_of(const Part& part) {
    constexpr std::size_t most_simulators = 16;
    const auto known = simulators_.find(part.setup.form);
    if (known != simulators_.end()) return known->second;
    if (simulators_.size() >= most_simulators) simulators_.clear();
    const Wishes wishes(models_[part.model], options_.keep_logs);
    const LaneOptions options{
        .log = {.enabled = wishes.log}, .end_row = wishes.end_row, .cancelled = options_.cancelled};
    return simulators_.try_emplace(part.setup.form, part.setup.plan, part.setup.settings, options)
        .first->second;
  }

  const std::vector<StudyModel>& models_;
  Setups& setups_;
  const EvaluatorOptions& options_;
  std::map<std::string, LaneSimulator> simulators_;  // by RunSetup::form
};

}  // namespace

struct Evaluator::Plans {
  explicit Plans(const std::vector<StudyModel>& of) : models(of), setups(of) {}
  const std::vector<StudyModel>& models;
  Setups setups;
};

Evaluator::Evaluator(const std::vector<StudyModel>& models) : plans_(std::make_unique<Plans>(models)) {}
Evaluator::~Evaluator() = default;

void Evaluator::run_groups(std::int64_t groups, const GroupSource& source, const GroupSink& sink,
                           const EvaluatorOptions& options) {
  Delivery<FinishedGroup> delivery(sink);
  const auto workers =
      static_cast<int>(std::clamp<std::int64_t>(options.threads, 1, std::max<std::int64_t>(groups, 1)));
  std::vector<Worker> crew;
  for (int k = 0; k < workers; ++k) crew.emplace_back(plans_->models, plans_->setups, options);
  in_parallel(groups, workers, [&](std::int64_t group, int worker) {
    if (options.cancelled && options.cancelled()) return;
    auto records = crew[worker].run(source(group));
    if (records) delivery.put({group, *std::move(records)});
  });
}

std::vector<RunRecord> Evaluator::run(std::span<const RunRequest> requests, const EvaluatorOptions& options) {
  std::vector<RunRecord> records(requests.size());
  for (RunRecord& record : records) record.status = RunStatus::interrupted;
  const auto runs = static_cast<std::int64_t>(requests.size());
  const auto group = [&](std::int64_t number) {
    const auto members = requests.subspan(number * group_size);
    const auto count = std::min<std::size_t>(group_size, members.size());
    return std::vector<RunRequest>(members.begin(), members.begin() + static_cast<std::ptrdiff_t>(count));
  };
  const auto keep = [&](std::vector<FinishedGroup>& finished) {
    for (FinishedGroup& part : finished) {
      for (std::size_t k = 0; k < part.records.size(); ++k) {
        const std::size_t run = part.number * group_size + k;
        records[run] = std::move(part.records[k]);
        if (options.done) options.done(run, records[run]);
      }
    }
  };
  run_groups((runs + group_size - 1) / group_size, group, keep, options);
  return records;
}

std::shared_ptr<const Plan> Evaluator::plan(int model, std::span<const Setting> settings) {
  return plans_->setups.make(model, settings).plan;
}

}  // namespace flyball
