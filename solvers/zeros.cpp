#include "solvers/zeros.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "solvers/plan_system.h"
#include "solvers/root.h"

namespace flyball {

Zeros::Zeros(const Plan& plan, Workspace<double>& workspace)
    : plan_(plan),
      workspace_(workspace),
      first_crossing_(static_cast<int>(plan.located_relations.size())),
      watched_(watch(plan)),
      affine_(plan, plan.zeros, slots_of(watched_)),
      affine_values_(watched_.size()),
      polynomial_(static_cast<int>(watched_.size())) {
  changed_.reserve(watched_.size());
  fired_.reserve(watched_.size());
  forced_now_.reserve(watched_.size());
  forced_.assign(plan.layout.size - plan.layout.first_relation, 0);
  forced_value_.assign(forced_.size(), 0.0);
  forced_level_ = forced_value_;
  scale_.assign(watched_.size(), 0.0);
}

std::vector<Zeros::Watched> Zeros::watch(const Plan& plan) {
  std::vector<Watched> watched;
  for (const int slot : plan.located_relations) {
    watched.push_back({slot, true, slot - plan.layout.first_relation, Direction::either});
  }
  for (int k = 0; k < plan.layout.crossings(); ++k) {
    watched.push_back({plan.layout.first_crossing + k, false, k, plan.crossing_records[k].direction});
  }
  return watched;
}

std::vector<int> Zeros::slots_of(const std::vector<Watched>& watched) {
  std::vector<int> slots;
  for (const Watched& w : watched) slots.push_back(w.slot);
  return slots;
}

int Zeros::side(const Watched& w) const {
  if (w.relation) return workspace_.bits[w.number] != 0 ? 1 : -1;
  return workspace_.sides[w.number];
}

bool Zeros::wanted(const Watched& w, double z) const {
  if (w.relation || w.direction == Direction::either) return true;
  return (w.direction == Direction::rising) == (z > 0.0);
}

void Zeros::collect() {
  changed_.clear();
  for (std::size_t k = 0; k < watched_.size(); ++k) {
    const Watched& w = watched_[k];
    const double z = value(w.slot);
    if (side(w) * z < 0.0 && wanted(w, z)) changed_.push_back(static_cast<int>(k));
  }
}

const std::vector<int>& Zeros::changed(bool after_rates) {
  evaluate(after_rates);
  collect();
  if (!changed_.empty()) return changed_;
  // Nothing fires in this step: crossings that went the other way are armed again.
  for (std::size_t k = first_crossing_; k < watched_.size(); ++k) {
    const double z = value(watched_[k].slot);
    if (z != 0.0) workspace_.sides[watched_[k].number] = z > 0.0 ? 1 : -1;
  }
  return changed_;
}

void Zeros::evaluate(bool after_rates) {
  ++evaluations_;
  if (!affine_.applies())
    return run(after_rates ? plan_.zeros_rest : plan_.zeros, plan_, frame(plan_, workspace_));
  const double* states = workspace_.values.data() + plan_.layout.first_state;
  affine_.evaluate(workspace_.values[0], states, affine_values_.data(), workspace_, workspace_.zeros_map);
  for (std::size_t k = 0; k < watched_.size(); ++k) workspace_.values[watched_[k].slot] = affine_values_[k];
}

void Zeros::evaluate_at(double t, Stepper<double>& stepper) {
  if (t == evaluated_) return;
  evaluated_ = t;
  if (polynomial_fits_) {
    for (int k = 0; k < polynomial_.signals(); ++k)
      workspace_.values[watched_[k].slot] = polynomial_.value(k, t);
    return;
  }
  workspace_.values[0] = t;
  stepper.interpolate(t, workspace_.values.data() + plan_.layout.first_state);
  evaluate(false);
}

/// Where one of the watched changes side between two times of the step.
double Zeros::find(int watched, double t0, double t1, Stepper<double>& stepper) {
  const Watched& w = watched_[watched];
  double& scale = scale_[watched];
  const auto seen = [&](double z) {
    scale = std::max(scale, std::fabs(z));
    return z;
  };
  if (polynomial_fits_) {
    return locate_root(
        t0, t1, side(w), [&](double t) { return seen(polynomial_.value(watched, t)); },
        [&](double t) { return polynomial_.slope(watched, t); });
  }
  return locate_root(t0, t1, side(w), [&](double t) {
    evaluate_at(t, stepper);
    return seen(value(w.slot));
  });
}

double Zeros::locate(double t0, double t1, Stepper<double>& stepper) {
  for (const int k : changed_) scale_[k] = std::fabs(value(watched_[k].slot));
  evaluated_ = std::numeric_limits<double>::quiet_NaN();
  const auto extension = affine_.applies() ? stepper.extension() : std::nullopt;
  polynomial_fits_ = extension.has_value();
  if (polynomial_fits_) polynomial_.fit(workspace_.zeros_map, *extension);
  double end = t1;
  for (std::size_t next = 0; next < changed_.size();) {
    const int k = changed_[next];
    const double found = find(k, t0, end, stepper);
    // By the rounding of the step, not of `end`: that may lie arbitrarily close to a step's beginning at 0.
    if (end - found <= same_instant(t1)) {  // simultaneous with what was found there
      ++next;
      continue;
    }
    end = found;
    evaluate_at(end, stepper);
    collect();
    // This one is settled; what else has changed by now changed earlier, or at the same time.
    const auto self = std::ranges::find(changed_, k);
    if (self != changed_.end()) std::iter_swap(changed_.begin(), self);
    next = self != changed_.end() ? 1 : 0;
  }
  evaluate_at(end, stepper);
  collect();
  return end;
}

void Zeros::force() {
  for (const int k : changed_) {
    const Watched& w = watched_[k];
    const bool up = value(w.slot) > 0.0;
    if (w.relation) {
      workspace_.bits[w.number] = up ? 1 : 0;
    } else {
      workspace_.sides[w.number] = up ? 1 : -1;
    }
  }
  // The sweep goes block by block, and may round to the other side: what it will find is what must not count.
  if (affine_.applies()) run(plan_.zeros, plan_, frame(plan_, workspace_));
  for (const int k : changed_) {
    const int at = watched_[k].slot - plan_.layout.first_relation;
    forced_[at] = 1;
    forced_value_[at] = value(watched_[k].slot);
    forced_level_[at] = plan_.loops.empty() ? 0.0 : loop_tolerance * std::max(1.0, scale_[k]);
    forced_now_.push_back(k);
  }
}

/// Whether what was forced has the value that it had then. A loop is solved again, with the forced bit: it
/// comes back to the same value within its tolerance only.
bool Zeros::is_held(int slot) const {
  const int at = slot - plan_.layout.first_relation;
  return forced_[at] != 0 && std::fabs(value(slot) - forced_value_[at]) <= forced_level_[at];
}

bool Zeros::settle(int slot) {
  const int at = slot - plan_.layout.first_relation;
  const double z = value(slot);
  const bool leaves = workspace_.bits[at] != 0 ? z < 0.0 : z > 0.0;
  if (!leaves || is_held(slot)) return false;
  workspace_.bits[at] = z > 0.0 ? 1 : 0;
  return true;
}

const std::vector<int>& Zeros::fired_crossings() {
  fired_.clear();
  run(plan_.crossings, plan_, frame(plan_, workspace_));
  for (std::size_t k = first_crossing_; k < watched_.size(); ++k) {
    const Watched& w = watched_[k];
    const double z = value(w.slot);
    if (z == 0.0 || is_held(w.slot)) continue;
    signed char& side = workspace_.sides[w.number];
    const bool edge = side * z < 0.0;
    side = z > 0.0 ? 1 : -1;
    if (edge && wanted(w, z)) fired_.push_back(w.number);
  }
  return fired_;
}

bool Zeros::must_rearm() const {
  return std::ranges::any_of(forced_now_, [&](int k) { return !watched_[k].relation; });
}

void Zeros::rearm(const double* dx, PlanSystem& system) {
  const bool affine = affine_.applies();
  const std::vector<double>* slopes = affine ? nullptr : &system.zero_rates(dx);
  for (const int k : forced_now_) {
    const Watched& w = watched_[k];
    if (w.relation) continue;
    const double slope = affine ? this->slope(k, dx) : (*slopes)[w.slot - plan_.layout.first_relation];
    // A root is located to a few ulp of time; 1e-10 of the value's size in the step covers its evaluation.
    const double t = workspace_.values[0];
    const double level = 1e-10 * scale_[k] + 16.0 * std::fabs(slope) * (std::nextafter(t, INFINITY) - t);
    if (std::fabs(value(w.slot)) <= level && slope != 0.0) workspace_.sides[w.number] = slope > 0.0 ? 1 : -1;
  }
}

/// The rate of change of an affine one along the rates `dx`.
double Zeros::slope(int watched, const double* dx) const {
  const int n = plan_.layout.states();
  const double* row = workspace_.zeros_map.matrix.data() + static_cast<std::ptrdiff_t>(watched) * n;
  return std::inner_product(row, row + n, dx, workspace_.zeros_map.slope[watched]);
}

void Zeros::release() {
  for (const int k : forced_now_) forced_[watched_[k].slot - plan_.layout.first_relation] = 0;
  forced_now_.clear();
}

std::string Zeros::name(int watched) const {
  const Watched& w = watched_[watched];
  return fmt::format("{} {}", w.relation ? "relation" : "crossing", plan_.slot_name(w.slot));
}

}  // namespace flyball
