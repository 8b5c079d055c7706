#include "solvers/plan_system.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solvers/bad_value.h"
#include "solvers/errors.h"

namespace flyball {

PlanSystem::PlanSystem(const Plan& plan, Workspace<double>& workspace)
    : plan_(plan),
      workspace_(workspace),
      affine_(plan, plan.rates, {}),
      held_rates_(plan),
      jets_(plan),
      jet_rates_(plan.layout.states()),
      zero_rates_(plan.layout.size - plan.layout.first_relation) {}

void PlanSystem::place(double t, const double* x) {
  workspace_.values[0] = t;
  double* states = workspace_.values.data() + plan_.layout.first_state;
  if (x != states) std::copy_n(x, size(), states);
}

void PlanSystem::rates(double t, const double* x, double* dx) {
  if (affine_.applies()) {
    if (affine_.evaluate(t, x, dx, workspace_, workspace_.rates_map)) return;
  }
  place(t, x);
  run(plan_.rates, plan_, frame(plan_, workspace_, dx));
  if (!all_finite(dx, size())) throw_first_bad({&plan_.rates}, plan_, workspace_);
}

void PlanSystem::rates_after_sweep(double* dx) {
  run(plan_.rates_only, plan_, frame(plan_, workspace_, dx));
  const double* x = workspace_.values.data() + plan_.layout.first_state;
  if (must_learn()) affine_.adopt(workspace_.values[0], x, dx, workspace_, workspace_.rates_map);
}

void PlanSystem::jacobian(double t, const double* x, double* values) {
  place(t, x);
  lift(workspace_, jets_);
  const Sparsity& pattern = plan_.pattern;
  Jet* states = jets_.values.data() + plan_.layout.first_state;
  const RunFrame<Jet> f = jet_frame();
  for (int first = 0; first < plan_.colouring.colours; first += Jet::DIMENSION) {
    const auto direction = [&](int c) { return plan_.colouring.colour[c] - first; };
    const auto seeded = [&](int c) { return direction(c) >= 0 && direction(c) < Jet::DIMENSION; };
    for (int c = 0; c < pattern.size; ++c) {
      states[c].v.setZero();
      if (seeded(c)) states[c].v[direction(c)] = 1.0;
    }
    run(plan_.rates, plan_, f);
    for (int c = 0; c < pattern.size; ++c) {
      if (!seeded(c)) continue;
      for (int k = pattern.start[c]; k < pattern.start[c + 1]; ++k) {
        values[k] = jet_rates_[pattern.row[k]].v[direction(c)];
        if (std::isfinite(values[k])) continue;
        throw SimulationError(SimulationError::Kind::not_finite, t,
                              fmt::format("the derivative of the rate of {} by {} is {} at t = {} s",
                                          state_name(pattern.row[k]), state_name(c), shown(values[k]), t));
      }
    }
  }
}

/// Memories are not copied: minor steps only read them.
RunFrame<Jet> PlanSystem::jet_frame() {
  RunFrame<Jet> f = frame(plan_, jets_, jet_rates_.data());
  f.memories = workspace_.memories.data();
  return f;
}

const std::vector<double>& PlanSystem::zero_rates(const double* dx) {
  lift(workspace_, jets_);
  jets_.values[0].v[0] = 1.0;
  for (int k = 0; k < size(); ++k) jets_.values[plan_.layout.first_state + k].v[0] = dx[k];
  run(plan_.zeros, plan_, jet_frame());
  for (std::size_t k = 0; k < zero_rates_.size(); ++k) {
    zero_rates_[k] = jets_.values[plan_.layout.first_relation + static_cast<int>(k)].v[0];
  }
  return zero_rates_;
}

bool all_finite(const double* x, int n) {
  // 0 times a finite number is 0, times anything else NaN; four sums hide the latency of one.
  double sum[4] = {0.0, 0.0, 0.0, 0.0};
  int k = 0;
  for (; k + 4 <= n; k += 4) {
    for (int j = 0; j < 4; ++j) sum[j] += 0.0 * x[k + j];
  }
  double rest = 0.0;
  for (; k < n; ++k) rest += 0.0 * x[k];
  return (n < 4 ? rest : (sum[0] + sum[1]) + (sum[2] + sum[3]) + rest) == 0.0;
}

bool outputs_are_finite(const Plan& plan, const Workspace<double>& workspace) {
  const Layout& layout = plan.layout;
  const double* v = workspace.values.data();
  if (!all_finite(v + layout.first_state, layout.first_relation - layout.first_state)) return false;
  // A limit may be infinite, so a relation may; NaN has no sign.
  return std::none_of(v + layout.first_relation, v + layout.first_alarm, [](double z) { return z != z; });
}

void throw_bad_next(int slot, double value, const Plan& plan, const Workspace<double>& workspace) {
  throw_bad_value("the next value of " + plan.slot_name(slot), value, plan.owner[slot], plan,
                  workspace.values.data());
}

void throw_first_bad(std::initializer_list<const Program*> programs, const Plan& plan,
                     Workspace<double>& workspace, bool hits) {
  const double t = workspace.values[0];
  for (int k = plan.layout.first_state; k < plan.layout.first_output; ++k) {
    if (std::isfinite(workspace.values[k])) continue;
    throw_bad_value(plan.slot_name(k), workspace.values[k], -1, plan, workspace.values.data());
  }
  std::vector<double> dx(plan.layout.states());
  const Frame<double> f = frame(plan, workspace, dx.data());
  for (const Program* program : programs) {
    for (const Op& op : program->ops) {
      for (int k = 0; k < op.count && (op.rate < 0 || hits); ++k) check_call(op, k, plan, f);
    }
  }
  throw SimulationError(SimulationError::Kind::not_finite, t,
                        fmt::format("a value is not finite at t = {} s", t));
}

}  // namespace flyball
