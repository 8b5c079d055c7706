#pragma once
#include "blocks/navigation/path.h"
#include "blocks/navigation/running_terms.h"
#include "blocks/se2.h"

namespace flyball {

struct CrossTrackError : RunningTerms {
  static constexpr auto summary = "Distance of a robot from the way that it is to follow.";
  explicit CrossTrackError(Settings* settings) : RunningTerms(settings, "m") {}
  SampleTime ts = sample_time();
  // In the order of `choices`.
  enum class From { segment, line, path };
  From from = static_cast<From>(
      option("from", "segment", {"segment", "line", "path"},
             "the way between two waypoints, the same without ends, or what an input `path` shows"));
  bool has_way = from != From::path;
  Pose<Input> pose = input_pose("pose", "of the robot");
  Pose<Input> previous = has_way ? input_pose("previous", "where the way comes from") : Pose<Input>{};
  Pose<Input> waypoint = has_way ? input_pose("waypoint", "where it goes to") : Pose<Input>{};
  ObjectInput<Path> path = has_way ? ObjectInput<Path>{} : object_input<Path>("path", "the points");
  Output distance = output("distance", "m", "from the way");
  Held begun = held("begun", 0.0, "1", "1 after the first hit");
  Held ax = held_if(has_way, "from_x", 0.0, "m", "the way at the last hit");
  Held ay = held_if(has_way, "from_y", 0.0, "m", "the way at the last hit");
  Held bx = held_if(has_way, "to_x", 0.0, "m", "the way at the last hit");
  Held by = held_if(has_way, "to_y", 0.0, "m", "the way at the last hit");

  // A robot has come here on the way of the last hit, and may choose another one now. To the first hit no way
  // has led: it shows 0, and does not count.
  void outputs(auto& v) const {
    const auto error = v[begun] * (has_way ? off_way(v) : off_path(v));
    v[distance] = error;
    show(v, error, counted(v) * v[begun]);
  }
  void on_sample(auto& v) const {
    keep(v, v[distance], counted(v) * v[begun]);
    v.next(begun) = 1.0;
    if (!has_way) return;
    v.next(ax) = v[previous.x];
    v.next(ay) = v[previous.y];
    v.next(bx) = v[waypoint.x];
    v.next(by) = v[waypoint.y];
  }

 private:
  auto place(auto& v) const { return Point<std::decay_t<decltype(v.time())>>{v[pose.x], v[pose.y]}; }
  auto off_way(auto& v) const {
    const decltype(place(v)) a{v[ax], v[ay]}, b{v[bx], v[by]};
    return from == From::line ? abs(right_of_line(place(v), a, b)) : distance_from_segment(place(v), a, b);
  }
  auto off_path(auto& v) const {
    const Path& points = v[path];
    const auto at = [&](int k) { return decltype(place(v)){v.number(points.x[k]), v.number(points.y[k])}; };
    auto nearest = distance_from_segment(place(v), at(0), at(1));
    for (int k = 2; k <= points.last(); ++k)
      nearest = min(nearest, distance_from_segment(place(v), at(k - 1), at(k)));
    return nearest;
  }
};

}  // namespace flyball
