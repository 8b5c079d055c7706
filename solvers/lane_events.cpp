#include "solvers/lane_events.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "solvers/root.h"
#include "solvers/zeros.h"

namespace flyball {
namespace {

LaneMask lane_bit(int lane) { return static_cast<LaneMask>(1u << lane); }

/// The lanes of a change of side that fire a crossing of this direction.
LaneMask wanted(Direction direction, LaneMask changed, const LaneSigns& signs) {
  if (direction == Direction::either) return changed;
  return changed & (direction == Direction::rising ? signs.above : signs.below);
}

}  // namespace

template <Isa isa>
LaneEvents<isa>::LaneEvents(LaneGroup<isa>& group, LaneStepper<isa>& stepper)
    : group_(group),
      stepper_(stepper),
      relations_(static_cast<int>(group.plan.located_relations.size())),
      watched_(group.plan.located_relations),
      forced_(group.plan.layout.size - group.plan.layout.first_relation, 0),
      forced_value_(forced_.size(), T(0.0)) {
  for (int k = 0; k < group.plan.layout.crossings(); ++k) {
    watched_.push_back(group.plan.layout.first_crossing + k);
  }
  signs_.resize(watched_.size());
  scale_.resize(watched_.size() * lane_count);
}

/// By the signs that were evaluated last.
template <Isa isa>
LaneMask LaneEvents<isa>::changed_lanes(int watched) const {
  const LaneSigns& z = signs_[watched];
  if (is_relation(watched)) {
    const LaneMask on = group_.bits[watched_[watched] - group_.plan.layout.first_relation];
    return group_.active() & ((on & z.below) | (~on & z.above));
  }
  const int k = number(watched);
  const LaneMask changed = (group_.up[k] & z.below) | (group_.down[k] & z.above);
  return group_.active() & wanted(group_.plan.crossing_records[k].direction, changed, z);
}

template <Isa isa>
int LaneEvents<isa>::side(int watched, int lane) const {
  const LaneMask up = is_relation(watched)
                          ? group_.bits[watched_[watched] - group_.plan.layout.first_relation]
                          : group_.up[number(watched)];
  return (up & lane_bit(lane)) != 0 ? 1 : -1;
}

template <Isa isa>
void LaneEvents<isa>::collect() {
  const int n = static_cast<int>(watched_.size());
  Arithmetic::signs(group_.values.data(), watched_.data(), n, signs_.data());
  changed_.clear();
  for (int k = 0; k < n; ++k) {
    const LaneMask lanes = changed_lanes(k);
    for (int lane = 0; lane < lane_count && lanes >> lane != 0; ++lane) {
      if ((lanes & lane_bit(lane)) != 0) changed_.push_back({k, lane_bit(lane)});
    }
  }
}

template <Isa isa>
void LaneEvents<isa>::take_side(int crossing, LaneMask above, LaneMask below) {
  group_.up[crossing] = static_cast<LaneMask>((group_.up[crossing] | above) & ~below);
  group_.down[crossing] = static_cast<LaneMask>((group_.down[crossing] | below) & ~above);
}

template <Isa isa>
bool LaneEvents<isa>::changed() {
  group_.run(group_.zeros_rest);
  collect();
  if (!changed_.empty()) return true;
  // Nothing fires in this step: crossings that went the other way are armed again.
  for (int k = relations_; k < static_cast<int>(watched_.size()); ++k) {
    take_side(number(k), signs_[k].above, signs_[k].below);
  }
  return false;
}

template <Isa isa>
void LaneEvents<isa>::evaluate_at(double t) {
  if (t == evaluated_) return;
  evaluated_ = t;
  stepper_.interpolate(t);
  group_.run(group_.zeros);
}

template <Isa isa>
double LaneEvents<isa>::locate(double t0, double t1) {
  for (std::size_t at = 0; at < scale_.size(); ++at) {
    scale_[at] = std::fabs(value(static_cast<int>(at) / lane_count, static_cast<int>(at) % lane_count));
  }
  evaluated_ = std::numeric_limits<double>::quiet_NaN();
  double end = t1;
  for (std::size_t next = 0; next < changed_.size();) {
    const Change c = changed_[next];
    const int lane = std::countr_zero(c.lanes);
    const double found = locate_root(t0, end, side(c.watched, lane), [&](double t) {
      evaluate_at(t);
      const double z = value(c.watched, lane);
      double& scale = scale_[c.watched * lane_count + lane];
      scale = std::max(scale, std::fabs(z));
      return z;
    });
    if (end - found <= same_instant(t1)) {  // simultaneous with what was found there
      ++next;
      continue;
    }
    end = found;
    evaluate_at(end);
    collect();
    // This one is settled; what else has changed by now changed earlier, or at the same time.
    const auto self = std::ranges::find_if(
        changed_, [&](const Change& other) { return other.watched == c.watched && other.lanes == c.lanes; });
    if (self != changed_.end()) std::iter_swap(changed_.begin(), self);
    next = self != changed_.end() ? 1 : 0;
  }
  found_at(end);
  return end;
}

template <Isa isa>
void LaneEvents<isa>::found_at(double t1) {
  evaluate_at(t1);
  collect();
}

template <Isa isa>
void LaneEvents<isa>::force() {
  for (const Change& c : changed_) {
    const int slot = watched_[c.watched], at = slot - group_.plan.layout.first_relation;
    const LaneMask up = c.lanes & signs_[c.watched].above, down = c.lanes & signs_[c.watched].below;
    if (is_relation(c.watched)) {
      group_.bits[at] = static_cast<LaneMask>((group_.bits[at] | up) & ~down);
    } else {
      take_side(number(c.watched), up, down);
    }
    forced_[at] |= c.lanes;
    forced_value_[at] = group_.values[slot];
    forced_now_.push_back(c);
  }
}

/// The lanes in which a forced side stays, as long as the value does not move.
template <Isa isa>
LaneMask LaneEvents<isa>::keeps(int slot) const {
  const int at = slot - group_.plan.layout.first_relation;
  if (forced_[at] == 0) return 0;
  return forced_[at] & Arithmetic::equal(group_.values[slot], forced_value_[at]);
}

template <Isa isa>
void LaneEvents<isa>::settle(int slot) {
  LaneSigns z;
  Arithmetic::signs(group_.values.data(), &slot, 1, &z);
  const LaneMask kept = keeps(slot);
  LaneMask& bit = group_.bits[slot - group_.plan.layout.first_relation];
  bit = static_cast<LaneMask>((bit | (z.above & ~kept)) & ~(z.below & ~kept));
}

template <Isa isa>
const std::vector<typename LaneEvents<isa>::Change>& LaneEvents<isa>::fired_crossings() {
  fired_.clear();
  group_.run(group_.crossings);
  const int n = static_cast<int>(watched_.size());
  Arithmetic::signs(group_.values.data(), watched_.data(), n, signs_.data());
  for (int k = relations_; k < n; ++k) {
    const LaneMask moves = static_cast<LaneMask>(~keeps(watched_[k]));
    const LaneSigns z{static_cast<LaneMask>(signs_[k].above & moves),
                      static_cast<LaneMask>(signs_[k].below & moves)};
    const int crossing = number(k);
    const LaneMask edge = (group_.up[crossing] & z.below) | (group_.down[crossing] & z.above);
    take_side(crossing, z.above, z.below);
    const LaneMask fired =
        group_.active() & wanted(group_.plan.crossing_records[crossing].direction, edge, z);
    if (fired != 0) fired_.push_back({k, fired});
  }
  return fired_;
}

template <Isa isa>
LaneMask LaneEvents<isa>::must_rearm() const {
  LaneMask lanes = 0;
  for (const Change& c : forced_now_) {
    if (!is_relation(c.watched)) lanes |= c.lanes;
  }
  return lanes & group_.active();
}

template <Isa isa>
void LaneEvents<isa>::rearm(int lane, const std::vector<double>& slopes) {
  for (const Change& c : forced_now_) {
    if (is_relation(c.watched) || c.lanes != lane_bit(lane)) continue;
    const double slope = slopes[watched_[c.watched] - group_.plan.layout.first_relation];
    // As Zeros: a root is located to a few ulp of time; 1e-10 of the value's size covers its evaluation.
    const double t = group_.time();
    const double level = 1e-10 * scale_[c.watched * lane_count + lane] +
                         16.0 * std::fabs(slope) * (std::nextafter(t, INFINITY) - t);
    if (std::fabs(value(c.watched, lane)) > level || slope == 0.0) continue;
    const LaneMask up = slope > 0.0 ? lane_bit(lane) : LaneMask{0};
    take_side(number(c.watched), up, static_cast<LaneMask>(lane_bit(lane) & ~up));
  }
}

template <Isa isa>
void LaneEvents<isa>::release() {
  for (const Change& c : forced_now_) forced_[watched_[c.watched] - group_.plan.layout.first_relation] = 0;
  forced_now_.clear();
}

template class LaneEvents<Isa::baseline>;
template class LaneEvents<Isa::avx2>;

}  // namespace flyball
