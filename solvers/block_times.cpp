#include "solvers/block_times.h"

#include <algorithm>
#include <chrono>

#include "solvers/zeros.h"

namespace flyball {
namespace {

std::vector<int> slots_of(const std::vector<LogColumn>& columns) {
  std::vector<int> slots;
  for (const LogColumn& column : columns) slots.push_back(column.slot);
  return slots;
}

template <class Call>
double seconds_of(int repeats, Call&& call) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  for (int k = 0; k < repeats; ++k) call();
  return std::chrono::duration<double>(Clock::now() - start).count() / repeats;
}

/// Short calls are repeated until the clock's own 20 to 50 ns do not show. The least of three is taken: other
/// programs of the machine only ever add.
template <class Call>
double seconds_a_call(Call&& call) {
  constexpr double long_enough = 4e-6;
  double least = seconds_of(1, call);
  const int repeats = static_cast<int>(std::clamp(long_enough / least, 1.0, 200.0));
  for (int k = 0; k < 2; ++k) least = std::min(least, seconds_of(repeats, call));
  return least;
}

}  // namespace

BlockTimes::BlockTimes(const Plan& plan)
    : plan_(plan),
      probe_(plan),
      system_(plan, probe_),
      rates_matrix_(plan, plan.rates, {}),
      zeros_matrix_(plan, plan.zeros, Zeros::slots(plan)),
      logs_matrix_(plan, plan.logs, slots_of(plan.columns)),
      rates_(plan.rates),
      zeros_(plan.zeros),
      logs_(plan.logs),
      sweep_(plan.sweep),
      states_(plan.layout.states()),
      results_(static_cast<std::size_t>(plan.layout.size) + plan.columns.size()),
      entries_(plan.pattern.row.size()) {}

void BlockTimes::sample(const Workspace<double>& workspace, const Stepper<double>& stepper) {
  probe_ = workspace;
  std::copy_n(probe_.values.data() + plan_.layout.first_state, states_.size(), states_.data());
  sample_program(sweep_);
  rates_matrix_.applies() ? sample_matrix(rates_, rates_matrix_, probe_.rates_map) : sample_program(rates_);
  zeros_matrix_.applies() ? sample_matrix(zeros_, zeros_matrix_, probe_.zeros_map) : sample_program(zeros_);
  logs_matrix_.applies() ? sample_matrix(logs_, logs_matrix_, probe_.logs_map) : sample_program(logs_);
  if (stepper.statistics().jacobians > 0) {
    const double t = probe_.values[0];
    jacobian_ += seconds_a_call([&] { system_.jacobian(t, states_.data(), entries_.data()); });
    ++jacobian_points_;
  }
  ++points_;
}

void BlockTimes::sample_program(Timed& timed) {
  const Frame<double> f = frame(plan_, probe_, results_.data());
  for (std::size_t k = 0; k < timed.operations.size(); ++k)
    timed.operations[k] += seconds_a_call([&] { call(timed.program.ops[k], plan_, f); });
}

void BlockTimes::sample_matrix(Timed& timed, AffineProgram& affine, Workspace<double>::Affine& map) {
  const auto evaluate = [&] {
    affine.evaluate(probe_.values[0], states_.data(), results_.data(), probe_, map);
  };
  evaluate();  // learns the matrix where the run had not needed it yet
  timed.is_matrix = true;
  timed.matrix += seconds_a_call(evaluate);
}

std::vector<BlockTime> BlockTimes::of(const ProgramCalls& calls) const {
  std::vector<BlockTime> times;
  for (const Instance& instance : plan_.diagram->instances)
    times.push_back({instance.name, instance.object->type->name});
  const auto add = [&](const Timed& timed, long count, const char* matrix_name) {
    const double points = std::max(points_, 1);
    if (timed.is_matrix)
      return times.push_back({matrix_name, "", static_cast<double>(count) * timed.matrix / points});
    for (std::size_t k = 0; k < timed.operations.size(); ++k) {
      const Op& op = timed.program.ops[k];
      const auto n = static_cast<double>(op.rate < 0 ? count : calls.hits[op.rate]);
      for (int i = op.place; i < op.place + op.count; ++i)
        times[plan_.placed[i]].seconds += n * timed.operations[k] / points / op.count;
    }
  };
  add(rates_, calls.rates, "(all rates, as one matrix)");
  add(zeros_, calls.zeros, "(all relations and crossings, as one matrix)");
  add(logs_, calls.logs, "(all logged signals, as one matrix)");
  add(sweep_, calls.sweeps, "");
  times.push_back(
      {"(Jacobian)", "", static_cast<double>(calls.jacobians) * jacobian_ / std::max(jacobian_points_, 1)});
  std::erase_if(times, [](const BlockTime& time) { return time.seconds == 0.0; });
  std::ranges::stable_sort(times, std::greater<>(), &BlockTime::seconds);
  return times;
}

}  // namespace flyball
