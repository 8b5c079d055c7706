#include "solvers/sensitivities.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "solvers/errors.h"
#include "solvers/parameters.h"
#include "solvers/sensitivity_pass.h"
#include "solvers/simulator.h"

namespace flyball {
namespace {

int signal_slot(const Plan& plan, const std::string& name) {
  const auto found = std::ranges::find(plan.columns, name, &LogColumn::name);
  if (found == plan.columns.end()) throw std::invalid_argument(fmt::format("{} is not logged", name));
  return found->slot;
}

void require_times(const std::vector<double>& times, double stop) {
  if (!std::ranges::is_sorted(times)) throw std::invalid_argument("times must ascend");
  if (times.empty() || !(times.front() >= 0.0) || !(times.back() <= stop))
    throw std::invalid_argument(fmt::format("times must be between 0 and the stop time {} s", stop));
}

/// What a block remembers along steps has no derivative.
void require_no_past(const Plan& plan) {
  for (const Op& op : plan.steps.ops) {
    if (op.phase != Phase::step) continue;
    const Instance& instance = plan.instance(plan.placed[op.place]);
    throw std::invalid_argument(fmt::format("derivatives do not go through {}: a {} remembers numbers alone",
                                            instance.name, op.object->type->name));
  }
}

}  // namespace

class Sensitivities::Run final : public InstantListener {
 public:
  Run(std::shared_ptr<const Plan> plan, const SimulationSettings& settings, SensitivityRequest request,
      const SensitivityOptions& options);

  void run(std::span<const double> parameters);
  const SensitivityTable& table() const { return table_; }
  const std::vector<double>& model_values() const { return model_values_; }

  void begins(const Due& due, const Zeros& zeros) override {
    for (auto& pass : passes_) pass->begins(due, zeros, approach_);
  }
  void swept(const Due* hits) override {
    for (auto& pass : passes_) pass->swept(hits);
  }
  void handled(const std::vector<HandlerCall>& calls) override {
    for (auto& pass : passes_) pass->handled(calls);
  }
  void ends() override {
    for (auto& pass : passes_) pass->ends();
    remember_approach();
  }

 private:
  void start_passes(std::span<const double> parameters);
  void remember_approach();

  std::shared_ptr<const Plan> plan_;
  SimulationSettings settings_;
  SensitivityRequest request_;
  std::vector<int> slots_;  // of the parameters
  std::vector<double> model_values_;
  SensitivityTable table_;
  std::vector<std::unique_ptr<SensitivityPass>> passes_;
  const Workspace<double>* numbers_ = nullptr;  // of the present run
  Approach approach_;
};

Sensitivities::Run::Run(std::shared_ptr<const Plan> plan, const SimulationSettings& settings,
                        SensitivityRequest request, const SensitivityOptions& options)
    : plan_(std::move(plan)), settings_(settings), request_(std::move(request)) {
  require_times(request_.times, settings.stop);
  require_no_past(*plan_);
  for (const std::string& name : request_.parameters) {
    slots_.push_back(settable_parameter(*plan_, name));
    model_values_.push_back(std::ranges::find(plan_->literals, slots_.back(), &Start::slot)->value);
  }
  for (const std::string& name : request_.signals) table_.slots.push_back(signal_slot(*plan_, name));
  table_.times = request_.times;
  table_.parameters = static_cast<int>(slots_.size());

  settings_.max_step = settings.max_step.value_or(settings.stop / 50.0);
  settings_.stop = request_.times.back();
  const bool stiff = settings.method == "bdf";
  settings_.method = stiff ? "bdf" : "dp5";
  settings_.atol = options.atol.value_or(settings.atol / settings.rtol * options.rtol);
  settings_.rtol = options.rtol;
  StepperOptions steps;
  steps.rtol = settings_.rtol;
  steps.atol = settings_.atol;
  steps.max_step = *settings_.max_step;
  steps.derivative_errors = true;
  const int passes =
      std::max(1, (table_.parameters + SensitivityPass::most_seeds - 1) / SensitivityPass::most_seeds);
  for (int k = 0; k < passes; ++k)
    passes_.push_back(std::make_unique<SensitivityPass>(*plan_, steps, stiff, table_));
}

void Sensitivities::Run::run(std::span<const double> parameters) {
  if (parameters.size() != slots_.size())
    throw std::invalid_argument(
        fmt::format("expected {} parameters, found {}", slots_.size(), parameters.size()));
  Simulator simulator(plan_, settings_, {false});
  ParameterSet set = request_.set;
  for (std::size_t p = 0; p < parameters.size(); ++p) set.emplace_back(slots_[p], parameters[p]);
  simulator.set_parameters(set);
  simulator.tell(*this);
  numbers_ = &simulator.workspace();
  table_.values.assign(table_.times.size() * table_.slots.size(), 0.0);
  table_.derivatives.assign(table_.values.size() * slots_.size(), 0.0);
  table_.warnings.clear();
  start_passes(parameters);
  for (bool more = true; more;) {
    remember_approach();
    more = simulator.advance();
  }
  if (simulator.time() < settings_.stop) {
    throw SimulationError(
        SimulationError::Kind::asserted, simulator.time(),
        fmt::format("the run ended at t = {} s, before the last time that is asked for ({})",
                    simulator.time(), simulator.end_reason()));
  }
  for (auto& pass : passes_) pass->finish(settings_.stop);
}

void Sensitivities::Run::start_passes(std::span<const double> parameters) {
  std::size_t p = 0;
  for (auto& pass : passes_) {
    std::vector<SensitivitySeed> seeds;
    for (; p < slots_.size() && seeds.size() < SensitivityPass::most_seeds; ++p) {
      const double scale = parameters[p] == 0.0 ? 1.0 : std::fabs(parameters[p]);
      seeds.push_back({request_.parameters[p], slots_[p], static_cast<int>(p), scale});
    }
    pass->start(*numbers_, std::move(seeds));
  }
}

void Sensitivities::Run::remember_approach() {
  const auto begin = numbers_->values.begin();
  approach_.time = numbers_->values[0];
  approach_.zeros.assign(begin + plan_->layout.first_relation, begin + plan_->layout.first_alarm);
}

Sensitivities::Sensitivities(std::shared_ptr<const Plan> plan, const SimulationSettings& settings,
                             SensitivityRequest request, SensitivityOptions options)
    : run_(std::make_unique<Run>(std::move(plan), settings, std::move(request), options)) {}
Sensitivities::Sensitivities(Sensitivities&&) noexcept = default;
Sensitivities::~Sensitivities() = default;

const std::vector<double>& Sensitivities::model_values() const { return run_->model_values(); }
void Sensitivities::run(std::span<const double> parameters) { run_->run(parameters); }

double Sensitivities::value(int time, int signal) const {
  return values()[static_cast<std::size_t>(time) * run_->table().slots.size() + signal];
}

double Sensitivities::derivative(int time, int signal, int parameter) const {
  const SensitivityTable& table = run_->table();
  const std::size_t row = static_cast<std::size_t>(time) * table.slots.size() + signal;
  return table.derivatives[row * table.parameters + parameter];
}

const std::vector<double>& Sensitivities::values() const { return run_->table().values; }
const std::vector<double>& Sensitivities::derivatives() const { return run_->table().derivatives; }
const std::vector<SensitivityWarning>& Sensitivities::warnings() const { return run_->table().warnings; }

}  // namespace flyball
