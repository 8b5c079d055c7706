#include "solvers/lane_simulator.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "solvers/bad_value.h"
#include "solvers/errors.h"
#include "solvers/lane_run.h"
#include "solvers/parallel.h"
#include "solvers/parameters.h"

namespace flyball {
namespace {

/// Whether the type has its equations on lanes: those of the catalogue that are not on double alone have.
bool has_lanes(const BlockType& type) {
  const Kernels<double>& single = type.kernels.on_double;
  const Kernels<Lanes<Isa::baseline>>& lanes = type.kernels.on_baseline_lanes;
  const auto alike = [](bool one, bool other) { return one == other; };
  return alike(single.outputs, lanes.outputs) && alike(single.rates, lanes.rates) &&
         alike(single.on_sample, lanes.on_sample) && alike(single.on_time, lanes.on_time) &&
         alike(single.on_crossing, lanes.on_crossing);
}

/// `auto` may choose another method than dp5 from the start.
std::string chosen_method(const Plan& plan, const SimulationSettings& settings) {
  Workspace<double> workspace(plan);
  return first_method(plan, PlanSystem(plan, workspace), settings);
}

/// The log of a run that is not logged: its row at the end.
Log end_log(const Simulator& simulator) {
  const Plan& plan = simulator.plan();
  Workspace<double> end = simulator.workspace();
  run(plan.logs, plan, frame(plan, end));
  Log log(plan);
  if (!log.append(end.values)) throw_first_bad({&plan.logs}, plan, end);
  return log;
}

}  // namespace

std::string refuses_lanes(const Plan& plan, const SimulationSettings& settings) {
  const std::string own = plan.layout.states() == 0 ? "discrete" : "dp5";
  if (settings.method != own && settings.method != "auto")
    return fmt::format("lanes run this diagram with the method {}, not with {}", own, settings.method);
  if (!plan.chains.empty()) return "an algebraic loop is solved for one run at a time";
  for (const Instance& instance : plan.diagram->instances) {
    const BlockType& type = *instance.object->type;
    if (!has_lanes(type))
      return fmt::format("{} is a {}, which exists on numbers alone", instance.name, type.name);
  }
  const std::string method = chosen_method(plan, settings);
  if (method != own && method != "auto") return fmt::format("auto takes the method {}", method);
  return "";
}

LaneSimulator::LaneSimulator(std::shared_ptr<const Plan> plan, const SimulationSettings& settings,
                             LaneOptions options)
    : plan_(std::move(plan)), settings_(settings), options_(std::move(options)), fresh_(*plan_) {
  if (refuses_lanes(*plan_, settings_).empty())
    group_ = LaneRun::make(options_.isa.value_or(widest_isa()), *plan_, settings_, options_.log);
}

LaneSimulator::~LaneSimulator() = default;

std::vector<LaneOutcome> LaneSimulator::run(std::span<const LaneInput> group) {
  std::vector<LaneOutcome> outcomes(group.size());
  if (group_) {
    Workspace<double> workspace(*plan_);
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      // The last run fills what is left of the group.
      const bool begun = begin(group[std::min(lane, group.size() - 1)], workspace);
      group_->load(static_cast<int>(lane), workspace, begun && lane < group.size());
    }
    if (!group_->run(options_.cancelled)) {
      for (LaneOutcome& outcome : outcomes) outcome.cancelled = true;
      return outcomes;
    }
  }
  for (std::size_t lane = 0; lane < group.size(); ++lane) {
    std::optional<LaneOutcome> outcome = outcome_of(static_cast<int>(lane));
    outcomes[lane] = outcome ? *std::move(outcome) : run_alone(group[lane]);
  }
  return outcomes;
}

/// False where the run fails before it begins.
bool LaneSimulator::begin(const LaneInput& input, Workspace<double>& workspace) const {
  workspace.values = fresh_.values;
  seed(*plan_, workspace, input.seed.value_or(settings_.seed));
  try {
    set_parameters(*plan_, input.parameters, workspace);
    initialise(*plan_, workspace);
    return true;
  } catch (const SimulationError&) {
    return false;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

/// Nothing where the run must go alone.
std::optional<LaneOutcome> LaneSimulator::outcome_of(int lane) const {
  if (!group_ || !group_->finished(lane)) return std::nullopt;
  LaneOutcome outcome;
  if (options_.log.enabled) {
    outcome.log = group_->take_log(lane);
  } else if (options_.end_row) {
    const std::vector<double>& row = group_->end_row(lane);
    outcome.log = Log(*plan_);
    if (!outcome.log->append(row[0], row.data() + 1)) return std::nullopt;
  }
  outcome.values.resize(plan_->layout.size);
  for (int s = 0; s < plan_->layout.size; ++s) outcome.values[s] = group_->value(s, lane);
  outcome.end = outcome.values[0];
  for (const int slot : plan_->run_ends) {
    if (outcome.values[slot] != 0.0 && outcome.end_reason.empty())
      outcome.end_reason = end_reason(*plan_, slot);
  }
  return outcome;
}

LaneOutcome LaneSimulator::run_alone(const LaneInput& input) const {
  LaneOutcome outcome;
  outcome.alone = true;
  SimulationSettings settings = settings_;
  settings.seed = input.seed.value_or(settings.seed);
  Simulator simulator(plan_, settings, options_.log);
  const auto watched = [&](double) {
    outcome.cancelled = options_.cancelled && options_.cancelled();
    return !outcome.cancelled;
  };
  try {
    simulator.set_parameters(input.parameters);
    simulator.run(watched);
    if (!options_.log.enabled && options_.end_row) outcome.log = end_log(simulator);
  } catch (const SimulationError& error) {
    outcome.error = error.what();
  } catch (const std::invalid_argument& error) {
    outcome.refused = true;
    outcome.error = error.what();
  }
  if (options_.log.enabled) outcome.log = simulator.log();
  outcome.values = simulator.workspace().values;
  outcome.end_reason = simulator.end_reason();
  outcome.end = simulator.time();
  outcome.statistics = simulator.statistics();
  return outcome;
}

std::vector<LaneOutcome> run_in_lanes(const std::shared_ptr<const Plan>& plan,
                                      const SimulationSettings& settings, std::span<const ParameterSet> sets,
                                      const LaneOptions& options) {
  if (options.isa && !supports(*options.isa))
    throw std::invalid_argument("this machine does not have the instructions that the lanes ask for");
  for (const ParameterSet& set : sets) {
    for (const auto& [slot, value] : set) require_settable(*plan, slot);
  }
  const auto runs = static_cast<int>(sets.size());
  const int groups = (runs + lane_count - 1) / lane_count;
  const int workers = std::clamp(options.threads, 1, std::max(groups, 1));
  std::vector<std::unique_ptr<LaneSimulator>> simulators;
  for (int k = 0; k < workers; ++k)
    simulators.push_back(std::make_unique<LaneSimulator>(plan, settings, options));
  std::vector<LaneOutcome> outcomes(sets.size());
  in_parallel(groups, workers, [&](std::int64_t task, int worker) {
    const auto first = static_cast<int>(task) * lane_count;
    std::vector<LaneInput> group;
    for (int k = first; k < std::min(first + lane_count, runs); ++k) group.push_back({sets[k]});
    std::ranges::move(simulators[worker]->run(group), outcomes.begin() + first);
  });
  for (const LaneOutcome& outcome : outcomes) {
    if (outcome.refused) throw std::invalid_argument(outcome.error);
  }
  return outcomes;
}

}  // namespace flyball
