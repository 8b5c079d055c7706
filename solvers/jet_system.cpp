#include "solvers/jet_system.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solvers/errors.h"

namespace flyball {

void JetSystem::place(const Jet& t, const Jet* x) {
  workspace_.values[0] = t;
  if (x != states()) std::copy_n(x, size(), states());
}

void JetSystem::rates(Jet t, const Jet* x, Jet* dx) {
  place(t, x);
  run(plan_.rates, plan_, frame(plan_, workspace_, dx));
  for (int i = 0; i < size(); ++i) {
    if (0.0 * dx[i].a + 0.0 * dx[i].v.sum() == 0.0) continue;  // NaN unless all are finite
    require_finite(dx[i], t.a, "the rate of " + state_name(i));
  }
}

void JetSystem::jacobian(double t, const double* x, double* values) {
  if (numbers_ == nullptr) numbers_ = std::make_unique<Numbers>(plan_);
  std::ranges::transform(workspace_.values, numbers_->workspace.values.begin(),
                         [](const Jet& y) { return y.a; });
  numbers_->workspace.bits = workspace_.bits;
  numbers_->system.jacobian(t, x, values);
}

void JetSystem::require_finite(const Jet& x, double t, const std::string& name) const {
  if (!std::isfinite(x.a)) {
    throw SimulationError(SimulationError::Kind::not_finite, t,
                          fmt::format("{} is {} at t = {} s", name, shown(x.a), t));
  }
  for (std::size_t d = 0; d < directions_.size(); ++d) {
    if (std::isfinite(x.v[d])) continue;
    throw SimulationError(
        SimulationError::Kind::not_finite, t,
        fmt::format("the derivative of {} by {} is {} at t = {} s", name, directions_[d], shown(x.v[d]), t));
  }
}

}  // namespace flyball
