#pragma once

#include <string>
#include <vector>

#include "studies/pareto/pareto.h"

namespace flyball {

/// Whether `a` is better than or equal to `b` everywhere, and better somewhere. All objectives are minimised.
bool dominates(const std::vector<double>& a, const std::vector<double>& b);

/// Keeps the points that no other point dominates, of all that it is shown. Of equal objectives, the first.
class ParetoArchive {
 public:
  void show(ParetoPoint point);
  /// Ordered by the first objective.
  const std::vector<ParetoPoint>& points() const { return points_; }
  /// At most `most` points, those in crowded places left out one by one (crowding distance of Deb et al.,
  /// NSGA-II, 2002, recomputed after each); the best point of each objective stays.
  std::vector<ParetoPoint> thinned(std::size_t most) const;

 private:
  std::vector<ParetoPoint> points_;
};

/// Crowding distance of each point: how far its neighbours are, over all objectives, each by its range.
/// Infinite for the best point of an objective.
std::vector<double> crowding_distances(const std::vector<ParetoPoint>& points);

/// How unevenly the points lie: the mean deviation of the distances to the next point from their mean, by
/// that mean (Deb's Delta without its extremes, which nobody knows here). Objectives count by their ranges.
/// 0: even; NaN with less than three points.
double spread(const std::vector<ParetoPoint>& points);

/// Objectives behind the first `minimised` change their sign: sought as minima, shown as what they are.
void turn_maximised(std::vector<double>& objectives, std::size_t minimised);

/// Smallest and largest value of each objective.
struct ObjectiveRanges {
  std::vector<double> lowest, highest;
  explicit ObjectiveRanges(const std::vector<ParetoPoint>& points);
  /// Where a value lies, from 0 to 1; 0 where the range is empty.
  double part(const ParetoPoint& point, std::size_t objective) const;
};

}  // namespace flyball
