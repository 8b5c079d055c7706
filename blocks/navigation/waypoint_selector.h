#pragma once
#include "blocks/block.h"
#include "blocks/navigation/path.h"

namespace flyball {

struct WaypointSelector : Block {
  static constexpr auto summary = "Shows a robot the next point of a path, until it has come near to each.";
  SampleTime ts = sample_time();
  // In the order of `choices`.
  enum class Heading { segment, bearing, next };
  Heading heading = static_cast<Heading>(
      option("heading", "segment", {"segment", "bearing", "next"},
             "of a waypoint: that of the way to it, from the robot to it, or of the way that follows it"));
  bool has_timeout = given("timeout");
  Param radius = param("transition_distance", 0.027, "m", positive, "how near is near enough");
  Param timeout =
      param_if(has_timeout, "timeout", 60.0, "s", positive, "time for one waypoint, if there is a limit");
  ObjectInput<Path> path = object_input<Path>("path", "the points");
  Pose<Input> pose = input_pose("pose", "where the robot is");
  Pose<Output> waypoint = output_pose("waypoint", "the point to drive to, and the heading wanted there");
  Pose<Output> previous = output_pose("previous", "the point before it; the heading of the way to that one");
  Output number = output("number", "1", "which point of the path is next; it begins at 0");
  Output done = output("done", "1", "1 when the robot has come near to the last one, which is then shown on");
  Output timed_out = output("timed_out", "1", "1 when the time for a waypoint has run out");
  Held next = held("next", 1.0, "1", "number of the next point; one more than the last one when done");
  Held since = held("since", 0.0, "s", "when that point was chosen");

  void outputs(auto& v) const {
    const Path& points = v[path];
    const auto due = still_ahead(v);
    const auto shown = stepwise([&](double k) { return std::min<double>(k, points.last()); }, due);
    const auto at = [&](const std::vector<double>& of, int shift) { return coordinate(of, shown, shift); };
    const auto x = at(points.x, 0), y = at(points.y, 0);
    v[waypoint.x] = x;
    v[waypoint.y] = y;
    v[waypoint.theta] = heading == Heading::bearing ? atan2(y - v[pose.y], x - v[pose.x])
                                                    : at(points.theta, heading == Heading::next ? 1 : 0);
    v[previous.x] = at(points.x, -1);
    v[previous.y] = at(points.y, -1);
    v[previous.theta] = at(points.theta, -1);
    v[number] = shown;
    v[done] = stepwise([&](double k) { return k > points.last() ? 1.0 : 0.0; }, due);
    v[timed_out] = has_timeout
                       ? stepwise([](double spent, double allowed) { return spent >= allowed ? 1.0 : 0.0; },
                                  waited(v, due), v[timeout])
                       : v.number(0.0);
  }
  void on_sample(auto& v) const {
    const auto due = still_ahead(v);
    v.next(next) = due;
    v.next(since) = v.time() - waited(v, due);
  }

 private:
  /// The first point that the robot is not near to: it may pass several at one hit.
  auto still_ahead(auto& v) const {
    const Path& points = v[path];
    // Coordinates are rounded, and a distance that is met counts.
    constexpr double slack = 1.0 + 1e-12;
    return stepwise(
        [&](double held, double x, double y, double reach) {
          int k = std::clamp(static_cast<int>(std::floor(held + 0.5)), 1, points.last() + 1);
          while (k <= points.last() && std::hypot(points.x[k] - x, points.y[k] - y) <= reach * slack) ++k;
          return static_cast<double>(k);
        },
        v[next], v[pose.x], v[pose.y], v[radius]);
  }
  /// Time since the point was chosen; 0 when that is now.
  auto waited(auto& v, const auto& due) const {
    const auto stays =
        stepwise([](double now, double before) { return now == before ? 1.0 : 0.0; }, due, v[next]);
    return stays * (v.time() - v[since]);
  }
  static auto coordinate(const std::vector<double>& of, const auto& number, int shift) {
    const int last = static_cast<int>(of.size()) - 1;
    return stepwise([&](double k) { return of[std::clamp(static_cast<int>(k) + shift, 0, last)]; }, number);
  }
};

}  // namespace flyball
