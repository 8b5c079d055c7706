#include "solvers/held_rates.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace flyball {
namespace {

/// Sums that stay below this are finite, whatever their order.
constexpr double safely_finite = 1e300;

}  // namespace

HeldRates::HeldRates(const Plan& plan) : plan_(plan), states_(plan.layout.states()) {
  std::ranges::set_difference(plan.externals, plan.switches, std::back_inserter(inputs_));
  for (const Op& op : plan.rates.ops) {
    if (op.phase != Phase::outputs) continue;
    const auto& slots = op.object->specification->slots;
    for (int k = 0; k < op.count * op.stride; ++k) {
      if (slots[k % op.stride].kind == SlotKind::output) outputs_.push_back(plan.index[op.first + k]);
    }
  }
}

bool HeldRates::switched(const Workspace<double>& workspace) {
  bool changed = rates_.version == 0;
  switches_.resize(plan_.switches.size());
  for (std::size_t k = 0; k < plan_.switches.size(); ++k) {
    const int relation = plan_.switches[k] - plan_.layout.first_relation;
    const double now = relation >= 0 ? workspace.bits[relation] : workspace.values[plan_.switches[k]];
    changed = changed || switches_[k] != now;
    switches_[k] = now;
  }
  return changed;
}

/// Evaluates the rates on Jets where states, inputs and time are 0. Time is the last direction.
void HeldRates::learn(const Workspace<double>& workspace) {
  if (jets_.empty()) {
    jets_.emplace_back(plan_);
    jet_rates_.resize(states_);
  }
  Workspace<Jet>& jets = jets_.front();
  lift(workspace, jets);
  const int inputs = static_cast<int>(inputs_.size());
  const auto source = [&](int direction) -> Jet& {
    if (direction < states_) return jets.values[plan_.layout.first_state + direction];
    return jets.values[direction < states_ + inputs ? inputs_[direction - states_] : 0];
  };
  const int directions = states_ + inputs + 1;
  for (int d = 0; d < directions; ++d) source(d) = Jet(0.0);
  rates_.matrix.resize(static_cast<std::size_t>(states_) * states_);
  rates_.inputs.resize(static_cast<std::size_t>(states_) * inputs);
  rates_.offset.resize(states_);
  reach_.assign(outputs_.size() + states_, 0.0);
  constant_ = true;
  for (int first = 0; first < directions; first += Jet::DIMENSION) {
    const int last = std::min(first + Jet::DIMENSION, directions);
    for (int d = first; d < last; ++d) source(d).v[d - first] = 1.0;
    run(plan_.rates, plan_, frame(plan_, jets, jet_rates_.data()));
    read_directions(jets, first, last);
    for (int d = first; d < last; ++d) source(d).v.setZero();
  }
  find_largest(jets);
  ++rates_.version;
}

void HeldRates::read_directions(const Workspace<Jet>& jets, int first, int last) {
  const int inputs = static_cast<int>(inputs_.size());
  for (int i = 0; i < states_; ++i) {
    for (int d = first; d < last; ++d) {
      const double derivative = jet_rates_[i].v[d - first];
      if (d < states_) {
        rates_.matrix[i * states_ + d] = derivative;
      } else if (d < states_ + inputs) {
        rates_.inputs[i * inputs + d - states_] = derivative;
      } else {
        constant_ = constant_ && derivative == 0.0;
      }
    }
    rates_.offset[i] = jet_rates_[i].a;
  }
  for (std::size_t k = 0; k < reach_.size(); ++k) {
    const Jet& y = k < outputs_.size() ? jets.values[outputs_[k]] : jet_rates_[k - outputs_.size()];
    reach_[k] += y.v.cwiseAbs().sum();
  }
}

void HeldRates::find_largest(const Workspace<Jet>& jets) {
  rates_.largest = safely_finite;
  for (std::size_t k = 0; k < reach_.size(); ++k) {
    const Jet& y = k < outputs_.size() ? jets.values[outputs_[k]] : jet_rates_[k - outputs_.size()];
    if (reach_[k] > 0.0)
      rates_.largest = std::min(rates_.largest, (safely_finite - std::fabs(y.a)) / reach_[k]);
  }
}

}  // namespace flyball
