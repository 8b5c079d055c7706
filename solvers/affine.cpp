#include "solvers/affine.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace flyball {
namespace {

/// A multiplication with its addition costs about an eighth of a call of a small block.
constexpr int entries_per_call = 8;

/// y = offset + slope t + matrix x; with the number of states known to the compiler, the loop over them is
/// unrolled.
template <int states>
bool product(const AffineProgram::Coefficients& map, double t, const double* x, double* y, int results,
             int n) {
  if constexpr (states > 0) n = states;
  const double* row = map.matrix.data();
  double zero = 0.0;
  for (int k = 0; k < results; ++k, row += n) {
    double sum = map.offset[k] + map.slope[k] * t;
    for (int j = 0; j < n; ++j) sum += row[j] * x[j];
    y[k] = sum;
    zero += 0.0 * sum;  // of a finite number
  }
  return zero == 0.0;
}

template <int... states>
AffineProgram::Product product_for(int n, std::integer_sequence<int, states...>) {
  constexpr AffineProgram::Product products[] = {product<states>...};
  return n < static_cast<int>(sizeof...(states)) ? products[n] : product<0>;
}

}  // namespace

AffineProgram::AffineProgram(const Plan& plan, const Program& program, std::vector<int> results)
    : plan_(plan),
      program_(program),
      slots_(std::move(results)),
      states_(plan.layout.states()),
      of_rates_(&program == &plan.rates),
      product_(product_for(states_, std::make_integer_sequence<int, 9>())),
      swept_(slots_.size()) {
  int calls = 1;
  for (const Op& op : program.ops) calls += op.count;
  applies_ = states_ > 0 && this->results() > 0 && this->results() * states_ <= entries_per_call * calls &&
             is_affine();
}

bool AffineProgram::is_affine() const {
  return std::ranges::all_of(program_.ops, [](const Op& op) {
    const SlotKind kind = result_of(op.phase);
    const auto& affine = op.phase == Phase::rates ? op.object->rate_affine : op.object->affine;
    const auto& slots = op.object->specification->slots;
    for (std::size_t s = 0; s < slots.size(); ++s) {
      if (slots[s].kind == kind && !affine[s]) return false;
    }
    return true;
  });
}

bool AffineProgram::is_autonomous() const {
  const auto reads_time = [](const Op& op) {
    const auto& reads = op.phase == Phase::rates ? op.object->rate_reads : op.object->reads;
    const auto is_time = [&](int s) { return op.object->specification->slots[s].kind == SlotKind::time; };
    return std::ranges::any_of(reads, [&](const auto& slots) { return std::ranges::any_of(slots, is_time); });
  };
  return std::ranges::none_of(program_.ops, reads_time);
}

bool AffineProgram::learn(double t, const double* x, double* y, Workspace<double>& workspace,
                          Coefficients& map) {
  workspace.values[0] = t;
  double* states = workspace.values.data() + plan_.layout.first_state;
  if (x != states) std::copy_n(x, states_, states);
  run(program_, plan_, frame(plan_, workspace, y));
  if (!of_rates_) std::ranges::transform(slots_, y, [&](int slot) { return workspace.values[slot]; });
  adopt(t, x, y, workspace, map);
  return std::all_of(y, y + results(), [](double value) { return std::isfinite(value); });
}

void AffineProgram::adopt(Workspace<double>& workspace, Coefficients& map) {
  std::ranges::transform(slots_, swept_.begin(), [&](int slot) { return workspace.values[slot]; });
  adopt(workspace.values[0], workspace.values.data() + plan_.layout.first_state, swept_.data(), workspace,
        map);
}

void AffineProgram::adopt(double t, const double* x, const double* y, Workspace<double>& workspace,
                          Coefficients& map) {
  if (switched(workspace, map)) differentiate(workspace, map);
  for (int k = 0; k < results(); ++k) {
    double rest = y[k] - map.slope[k] * t;
    for (int j = 0; j < states_; ++j) rest -= map.matrix[k * states_ + j] * x[j];
    map.offset[k] = rest;
  }
  map.stale = false;
}

bool AffineProgram::switched(const Workspace<double>& workspace, Coefficients& map) const {
  bool changed = map.switches.size() != plan_.switches.size();
  map.switches.resize(plan_.switches.size());
  for (std::size_t k = 0; k < plan_.switches.size(); ++k) {
    const int relation = plan_.switches[k] - plan_.layout.first_relation;
    const double now = relation >= 0 ? workspace.bits[relation] : workspace.values[plan_.switches[k]];
    changed = changed || map.switches[k] != now;
    map.switches[k] = now;
  }
  return changed || map.matrix.empty();
}

void AffineProgram::differentiate(Workspace<double>& workspace, Coefficients& map) {
  if (jets_.empty()) {
    jets_.emplace_back(plan_);
    jet_rates_.resize(states_);
  }
  Workspace<Jet>& jets = jets_.front();
  lift(workspace, jets);
  const int m = results();
  map.matrix.resize(static_cast<std::size_t>(states_) * m);
  map.slope.resize(m);
  map.offset.resize(m);
  const auto source = [&](int direction) -> Jet& {  // time comes after the states
    return direction < states_ ? jets.values[plan_.layout.first_state + direction] : jets.values[0];
  };
  for (int first = 0; first <= states_; first += Jet::DIMENSION) {
    const int last = std::min(first + Jet::DIMENSION, states_ + 1);
    for (int j = first; j < last; ++j) source(j).v[j - first] = 1.0;
    run(program_, plan_, frame(plan_, jets, jet_rates_.data()));
    for (int k = 0; k < m; ++k) {
      const Jet& y = of_rates_ ? jet_rates_[k] : jets.values[slots_[k]];
      for (int j = first; j < last; ++j)
        (j < states_ ? map.matrix[k * states_ + j] : map.slope[k]) = y.v[j - first];
    }
    for (int j = first; j < last; ++j) source(j).v.setZero();
  }
}

}  // namespace flyball
