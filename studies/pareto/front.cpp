#include "studies/pareto/front.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace flyball {

bool dominates(const std::vector<double>& a, const std::vector<double>& b) {
  bool better = false;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (a[k] > b[k]) return false;
    better |= a[k] < b[k];
  }
  return better;
}

void ParetoArchive::show(ParetoPoint point) {
  const auto beats_it = [&](const ParetoPoint& other) {
    return other.objectives == point.objectives || dominates(other.objectives, point.objectives);
  };
  if (std::ranges::any_of(points_, beats_it)) return;
  std::erase_if(points_,
                [&](const ParetoPoint& other) { return dominates(point.objectives, other.objectives); });
  const auto place = std::ranges::lower_bound(points_, point.objectives, {}, &ParetoPoint::objectives);
  points_.insert(place, std::move(point));
}

std::vector<ParetoPoint> ParetoArchive::thinned(std::size_t most) const {
  std::vector<ParetoPoint> kept = points_;
  while (kept.size() > most) {
    const std::vector<double> distances = crowding_distances(kept);
    const auto most_crowded = std::ranges::min_element(distances);
    if (std::isinf(*most_crowded)) break;
    kept.erase(kept.begin() + (most_crowded - distances.begin()));
  }
  return kept;
}

std::vector<double> crowding_distances(const std::vector<ParetoPoint>& points) {
  std::vector<double> distances(points.size(), 0.0);
  if (points.empty()) return distances;
  const ObjectiveRanges ranges(points);
  std::vector<std::size_t> order(points.size());
  for (std::size_t k = 0; k < points[0].objectives.size(); ++k) {
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t p) { return points[p].objectives[k]; });
    distances[order.front()] = distances[order.back()] = std::numeric_limits<double>::infinity();
    for (std::size_t j = 1; j + 1 < order.size(); ++j) {
      distances[order[j]] += ranges.part(points[order[j + 1]], k) - ranges.part(points[order[j - 1]], k);
    }
  }
  return distances;
}

double spread(const std::vector<ParetoPoint>& points) {
  if (points.size() < 3) return std::numeric_limits<double>::quiet_NaN();
  const ObjectiveRanges ranges(points);
  const auto distance = [&](const ParetoPoint& a, const ParetoPoint& b) {
    double square = 0.0;
    for (std::size_t k = 0; k < a.objectives.size(); ++k) {
      square += std::pow(ranges.part(a, k) - ranges.part(b, k), 2);
    }
    return std::sqrt(square);
  };
  // With two objectives the next point is the next in order; with more it is the nearest.
  const bool ordered = points[0].objectives.size() == 2;
  std::vector<double> gaps;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (ordered && i + 1 == points.size()) break;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < points.size(); ++j) {
      if (ordered ? j == i + 1 : j != i) nearest = std::min(nearest, distance(points[i], points[j]));
    }
    gaps.push_back(nearest);
  }
  const double mean = std::accumulate(gaps.begin(), gaps.end(), 0.0) / static_cast<double>(gaps.size());
  double deviation = 0.0;
  for (const double gap : gaps) deviation += std::abs(gap - mean);
  return deviation / (static_cast<double>(gaps.size()) * mean);
}

ObjectiveRanges::ObjectiveRanges(const std::vector<ParetoPoint>& points) {
  if (points.empty()) return;
  lowest = highest = points[0].objectives;
  for (const ParetoPoint& point : points) {
    for (std::size_t k = 0; k < lowest.size(); ++k) {
      lowest[k] = std::min(lowest[k], point.objectives[k]);
      highest[k] = std::max(highest[k], point.objectives[k]);
    }
  }
}

double ObjectiveRanges::part(const ParetoPoint& point, std::size_t objective) const {
  const double range = highest[objective] - lowest[objective];
  return range > 0.0 ? (point.objectives[objective] - lowest[objective]) / range : 0.0;
}

void turn_maximised(std::vector<double>& objectives, std::size_t minimised) {
  for (std::size_t k = minimised; k < objectives.size(); ++k) objectives[k] = -objectives[k];
}

std::vector<Setting> ParetoResult::settings() const {
  std::vector<Setting> result;
  if (picked < 0) return result;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    result.push_back({parameters[k], front[picked].parameters[k]});
  }
  return result;
}

int pick_point(const ParetoResult& result, const std::string& pick, const std::vector<double>& weights) {
  if (result.front.empty()) return -1;
  std::vector<ParetoPoint> front = result.front;
  for (ParetoPoint& point : front) turn_maximised(point.objectives, result.minimised);
  const ObjectiveRanges ranges(front);
  const auto named = std::ranges::find(result.objectives, pick);
  const auto cost = [&](const ParetoPoint& point) {
    if (named != result.objectives.end()) {
      return point.objectives[static_cast<std::size_t>(named - result.objectives.begin())];
    }
    // The knee lies farthest from the plane through the best points of each objective: with all ranges made
    // equal, that is where their sum is least.
    double sum = 0.0;
    for (std::size_t k = 0; k < point.objectives.size(); ++k) {
      sum += (pick == "weights" ? weights[k] : 1.0) * ranges.part(point, k);
    }
    return sum;
  };
  return static_cast<int>(std::ranges::min_element(front, {}, cost) - front.begin());
}

}  // namespace flyball
