#include "blocks/navigation/probabilistic_roadmap.h"

#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/datastructures/NearestNeighborsLinear.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/util/Console.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <utility>

#include "blocks/random.h"
#include "blocks/specification.h"

namespace flyball {
namespace {

namespace ob = ompl::base;
using Place = Point<double>;
using Places = std::vector<Place>;

Place place_of(const ob::State* state) {
  const auto* at = state->as<ob::RealVectorStateSpace::StateType>();
  return {at->values[0], at->values[1]};
}

double length(const Place& a, const Place& b) { return std::hypot(b.x - a.x, b.y - a.y); }

/// The first two samples are start and goal, so that they are the first milestones; then places of our own
/// random numbers, since those of OMPL belong to the program, not to a request.
class Sampler : public ob::ValidStateSampler {
 public:
  Sampler(const ob::SpaceInformation* space, const Scene& scene, const PathRequest& request)
      : ob::ValidStateSampler(space), scene_(scene), request_(request) {}

  bool sample(ob::State* state) override {
    auto* at = state->as<ob::RealVectorStateSpace::StateType>();
    const Place place = taken_ == 0 ? request_.start : taken_ == 1 ? request_.goal : drawn();
    ++taken_;
    at->values[0] = place.x;
    at->values[1] = place.y;
    return si_->isValid(state);
  }
  bool sampleNear(ob::State*, const ob::State*, double) override { return false; }

 private:
  Place drawn() {
    const auto stream = static_cast<double>(request_.seed);
    const double u = uniform_number(stream, 2.0 * taken_), v = uniform_number(stream, 2.0 * taken_ + 1.0);
    return {scene_.lower.x + u * (scene_.upper.x - scene_.lower.x),
            scene_.lower.y + v * (scene_.upper.y - scene_.lower.y)};
  }

  const Scene& scene_;
  const PathRequest& request_;
  int taken_ = 0;
};

/// Whether straight lines keep the robot clear, at all of their points.
class StraightLines : public ob::MotionValidator {
 public:
  StraightLines(const ob::SpaceInformationPtr& space, const Scene& scene, double radius)
      : ob::MotionValidator(space), scene_(scene), radius_(radius) {}

  bool checkMotion(const ob::State* a, const ob::State* b) const override {
    return scene_.clearance(place_of(a), place_of(b)) >= radius_;
  }
  bool checkMotion(const ob::State* a, const ob::State* b,
                   std::pair<ob::State*, double>& last) const override {
    last.second = 0.0;
    return checkMotion(a, b);
  }

 private:
  const Scene& scene_;
  double radius_;
};

ob::SpaceInformationPtr space_of(const Scene& scene, const PathRequest& request) {
  const auto plane = std::make_shared<ob::RealVectorStateSpace>(2);
  ob::RealVectorBounds bounds(2);
  bounds.low = {scene.lower.x, scene.lower.y};
  bounds.high = {scene.upper.x, scene.upper.y};
  plane->setBounds(bounds);
  auto space = std::make_shared<ob::SpaceInformation>(plane);
  space->setStateValidityChecker(
      [&](const ob::State* state) { return scene.clearance(place_of(state)) >= request.radius; });
  space->setMotionValidator(std::make_shared<StraightLines>(space, scene, request.radius));
  space->setValidStateSamplerAllocator(
      [&](const ob::SpaceInformation* of) { return std::make_shared<Sampler>(of, scene, request); });
  space->setup();
  return space;
}

/// A roadmap: places, the first two of which are start and goal, and which of them a robot can drive between.
struct Roadmap {
  Places places;
  std::vector<std::vector<unsigned>> joined;
};

/// With a search for neighbours that has no random numbers.
class Grower : public ompl::geometric::PRM {
 public:
  Grower(const ob::SpaceInformationPtr& space, int neighbours) : PRM(space) {
    nn_ = std::make_shared<ompl::NearestNeighborsLinear<Vertex>>();
    nn_->setDistanceFunction([this](const Vertex a, const Vertex b) { return distanceFunction(a, b); });
    setMaxNearestNeighbors(static_cast<unsigned>(neighbours));
    setProblemDefinition(std::make_shared<ob::ProblemDefinition>(space));
  }

  Roadmap map() const {
    Roadmap result;
    for (Vertex v = 0; v < milestoneCount(); ++v) {
      result.places.push_back(place_of(boost::get(vertex_state_t(), getRoadmap(), v)));
      std::vector<unsigned>& joined = result.joined.emplace_back();
      const auto [first, last] = boost::adjacent_vertices(v, getRoadmap());
      for (auto next = first; next != last; ++next) joined.push_back(static_cast<unsigned>(*next));
    }
    return result;
  }
};

Roadmap make_roadmap(const Scene& scene, const PathRequest& request, unsigned long samples) {
  Grower grower(space_of(scene, request), request.neighbours);
  // A crowded scene may have no room for so many.
  const unsigned long most_tries = 100 * samples;
  unsigned long tries = 0;
  grower.growRoadmap(ob::PlannerTerminationCondition(
      [&] { return grower.milestoneCount() >= samples || ++tries > most_tries; }));
  return grower.map();
}

/// Dijkstra's algorithm, from place 0 to place 1. Nothing when they are not connected.
std::optional<Places> shortest(const Roadmap& map) {
  std::vector<double> far(map.places.size(), infinity);
  std::vector<unsigned> from(map.places.size(), 0);
  std::priority_queue<std::pair<double, unsigned>, std::vector<std::pair<double, unsigned>>, std::greater<>>
      open;
  open.emplace(far[0] = 0.0, 0u);
  while (!open.empty() && open.top().second != 1u) {
    const auto [distance, at] = open.top();
    open.pop();
    if (distance > far[at]) continue;
    for (const unsigned next : map.joined[at]) {
      const double reached = distance + length(map.places[at], map.places[next]);
      if (reached >= far[next]) continue;
      from[next] = at;
      open.emplace(far[next] = reached, next);
    }
  }
  if (open.empty()) return std::nullopt;
  Places path;
  for (unsigned at = 1; at != 0; at = from[at]) path.push_back(map.places[at]);
  path.push_back(map.places[0]);
  std::ranges::reverse(path);
  return path;
}

/// From each corner that stays, straight on to the last one that can be seen.
Places without_detours(const Places& path, const Scene& scene, double radius) {
  Places result{path.front()};
  for (std::size_t at = 0; at + 1 < path.size();) {
    std::size_t next = path.size() - 1;
    while (next > at + 1 && scene.clearance(path[at], path[next]) < radius) --next;
    result.push_back(path[at = next]);
  }
  return result;
}

/// A line through corners, by the way along it.
class Line {
 public:
  explicit Line(Places corners) : corners_(std::move(corners)), ways_{0.0} {
    for (std::size_t k = 1; k < corners_.size(); ++k)
      ways_.push_back(ways_.back() + length(corners_[k - 1], corners_[k]));
  }

  double length_of_all() const { return ways_.back(); }
  Place at(double way) const {
    const auto end = std::ranges::upper_bound(ways_, way);
    if (end == ways_.end()) return corners_.back();
    const auto k = static_cast<std::size_t>(end - ways_.begin());
    const double part = (way - ways_[k - 1]) / (ways_[k] - ways_[k - 1]);
    const Place &a = corners_[k - 1], &b = corners_[k];
    return {a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)};
  }
  /// The way to the first corner between two ways; nothing without one.
  std::optional<double> corner_between(double from, double to) const {
    const auto next = std::ranges::upper_bound(ways_, from);
    return next != ways_.end() && *next < to ? std::optional(*next) : std::nullopt;
  }

 private:
  Places corners_;
  std::vector<double> ways_;
};

/// Ways to points at equal distances, some of which have moved to corners. Nothing where there are more
/// corners that matter than points.
std::optional<Places> resampled(const Line& line, int pieces, const Scene& scene, double radius) {
  std::vector<double> ways;
  for (int k = 0; k <= pieces; ++k) ways.push_back(line.length_of_all() * k / pieces);
  ways.back() = line.length_of_all();  // in spite of rounding
  std::vector<bool> stays(ways.size(), false);
  stays.front() = stays.back() = true;
  for (std::size_t k = 0; k + 1 < ways.size();) {
    const auto corner = line.corner_between(ways[k], ways[k + 1]);
    if (!corner || scene.clearance(line.at(ways[k]), line.at(ways[k + 1])) >= radius) {
      ++k;
      continue;
    }
    const bool first_is_near = *corner - ways[k] < ways[k + 1] - *corner;
    const bool takes_first = !stays[k] && (first_is_near || stays[k + 1]);
    if (!takes_first && stays[k + 1]) return std::nullopt;
    const std::size_t moved = takes_first ? k : k + 1;
    ways[moved] = *corner;
    stays[moved] = true;
    if (takes_first) --k;  // the piece before it has changed, too
  }
  Places points;
  for (const double way : ways) points.push_back(line.at(way));
  return points;
}

}  // namespace

std::variant<Places, NoPath> plan_path(const Scene& scene, const PathRequest& request) {
  ompl::msg::noOutputHandler();
  if (scene.clearance(request.start) < request.radius) return NoPath::start_blocked;
  if (scene.clearance(request.goal) < request.radius) return NoPath::goal_blocked;
  const bool straight = scene.clearance(request.start, request.goal) >= request.radius;
  constexpr int doublings = 3;
  for (int k = 0; k <= doublings; ++k) {
    const auto samples = static_cast<unsigned long>(request.samples) << k;
    const auto path =
        straight ? Places{request.start, request.goal} : shortest(make_roadmap(scene, request, samples));
    if (!path) continue;
    const Line line(without_detours(*path, scene, request.radius));
    auto points = resampled(line, request.waypoints, scene, request.radius);
    if (!points) return NoPath::too_few_waypoints;
    return *std::move(points);
  }
  return NoPath::not_connected;
}

}  // namespace flyball
