#include "solvers/lane_simulator.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "solvers/errors.h"
#include "solvers/lane_run.h"
#include "solvers/parameters.h"

namespace flyball {
namespace {

/// Calls work(task, worker) for each task, on as many threads as workers. Rethrows the first failure.
void in_parallel(int tasks, int workers, const std::function<void(int, int)>& work) {
  std::atomic<int> next = 0;
  std::exception_ptr failure;
  std::mutex guard;
  const auto serve = [&](int worker) {
    try {
      for (int task = next++; task < tasks; task = next++) work(task, worker);
    } catch (...) {
      const std::lock_guard lock(guard);
      if (!failure) failure = std::current_exception();
      next = tasks;
    }
  };
  std::vector<std::jthread> threads;
  for (int worker = 1; worker < workers; ++worker) threads.emplace_back(serve, worker);
  serve(0);
  threads.clear();
  if (failure) std::rethrow_exception(failure);
}

/// Whether the type has its equations on lanes: those of the catalogue that are not on double alone have.
bool has_lanes(const BlockType& type) {
  const Kernels<double>& single = type.kernels.on_double;
  const Kernels<Lanes<Isa::baseline>>& lanes = type.kernels.on_baseline_lanes;
  const auto alike = [](bool one, bool other) { return one == other; };
  return alike(single.outputs, lanes.outputs) && alike(single.rates, lanes.rates) &&
         alike(single.on_sample, lanes.on_sample) && alike(single.on_time, lanes.on_time) &&
         alike(single.on_crossing, lanes.on_crossing);
}

class Runner {
 public:
  Runner(std::shared_ptr<const Plan> plan, const SimulationSettings& settings,
         std::span<const ParameterSet> sets, const LaneOptions& options)
      : plan_(std::move(plan)),
        settings_(settings),
        sets_(sets),
        options_(options),
        fresh_(*plan_),
        outcomes_(sets.size()) {}

  std::vector<LaneOutcome> run() {
    const bool lanes = runs() > 0 && refuses_lanes(*plan_, settings_).empty() && begins_explicitly();
    const int size = lanes ? lane_count : 1;
    const int tasks = (runs() + size - 1) / size;
    const int workers = std::clamp(options_.threads, 1, std::max(tasks, 1));
    std::vector<std::unique_ptr<LaneRun>> groups;
    for (int k = 0; lanes && k < workers; ++k) {
      groups.push_back(LaneRun::make(options_.isa.value_or(widest_isa()), *plan_, settings_, options_.log));
    }
    in_parallel(tasks, workers, [&](int task, int worker) {
      if (lanes) {
        run_group(task * size, *groups[worker]);
      } else {
        run_alone(task);
      }
    });
    return std::move(outcomes_);
  }

 private:
  int runs() const { return static_cast<int>(sets_.size()); }

  void run_group(int first, LaneRun& group) {
    Workspace<double> workspace(*plan_);
    bool begun[lane_count];
    for (int lane = 0; lane < lane_count; ++lane) {
      // The last run fills what is left of the last group.
      begun[lane] = begin(sets_[std::min(first + lane, runs() - 1)], workspace);
      group.load(lane, workspace, begun[lane] && first + lane < runs());
    }
    group.run();
    for (int lane = 0; lane < lane_count && first + lane < runs(); ++lane) {
      if (!group.finished(lane)) {
        run_alone(first + lane);
        continue;
      }
      LaneOutcome& outcome = outcomes_[first + lane];
      outcome.values.resize(plan_->layout.size);
      for (int s = 0; s < plan_->layout.size; ++s) outcome.values[s] = group.value(s, lane);
      if (options_.log.enabled) outcome.log = group.take_log(lane);
    }
  }

  /// The method auto turns away from dp5 where a run is stiff, and lanes do not: so the first run decides.
  bool begins_explicitly() {
    if (settings_.method != "auto") return true;
    Simulator simulator(plan_, settings_, {.enabled = false});
    set_parameters(simulator, sets_.front());
    try {
      simulator.run();
    } catch (const SimulationError&) {
      // Of this run alone; it says nothing about the others.
    }
    return simulator.method().method == "dp5";
  }

  void set_parameters(Simulator& simulator, const ParameterSet& set) const {
    for (const auto& [slot, value] : set) simulator.set_parameter(plan_->slot_name(slot), value);
  }

  /// False where the run fails before it begins.
  bool begin(const ParameterSet& set, Workspace<double>& workspace) const {
    workspace.values = fresh_.values;
    for (const auto& [slot, value] : set) workspace.values[slot] = value;
    derive(*plan_, workspace);
    require_in_range(*plan_, workspace);
    try {
      initialise(*plan_, workspace);
      return true;
    } catch (const SimulationError&) {
      return false;
    }
  }

  void run_alone(int run) {
    LaneOutcome& outcome = outcomes_[run];
    outcome.alone = true;
    Simulator simulator(plan_, settings_, options_.log);
    set_parameters(simulator, sets_[run]);
    try {
      simulator.run();
    } catch (const SimulationError& error) {
      outcome.error = error.what();
    }
    outcome.values = simulator.workspace().values;
    if (options_.log.enabled) outcome.log = simulator.log();
  }

  std::shared_ptr<const Plan> plan_;
  const SimulationSettings& settings_;
  std::span<const ParameterSet> sets_;
  const LaneOptions& options_;
  Workspace<double> fresh_;  // what a run begins with before its parameters are set
  std::vector<LaneOutcome> outcomes_;
};

}  // namespace

std::string refuses_lanes(const Plan& plan, const SimulationSettings& settings) {
  if (settings.method != "dp5" && settings.method != "auto")
    return fmt::format("lanes run with the method dp5, not with {}", settings.method);
  if (plan.layout.states() == 0) return "there are no states to integrate";
  if (!plan.chains.empty()) return "an algebraic loop is solved for one run at a time";
  for (const int slot : plan.run_ends) {
    return fmt::format("{} may end a run before the others", plan.instance(plan.owner[slot]).name);
  }
  for (const Instance& instance : plan.diagram->instances) {
    const BlockType& type = *instance.object->type;
    if (!has_lanes(type))
      return fmt::format("{} is a {}, which exists on numbers alone", instance.name, type.name);
  }
  return "";
}

std::vector<LaneOutcome> run_in_lanes(const std::shared_ptr<const Plan>& plan,
                                      const SimulationSettings& settings, std::span<const ParameterSet> sets,
                                      const LaneOptions& options) {
  if (options.isa && !supports(*options.isa))
    throw std::invalid_argument("this machine does not have the instructions that the lanes ask for");
  for (const ParameterSet& set : sets) {
    for (const auto& [slot, value] : set) require_settable(*plan, slot);
  }
  return Runner(plan, settings, sets, options).run();
}

}  // namespace flyball
