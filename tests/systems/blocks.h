#pragma once

#include <functional>
#include <type_traits>

#include "blocks/block.h"

namespace flyball::test {

/// An integrator that shows each evaluation of its rate to the test.
struct Spy : Block {
  static constexpr auto summary = "An integrator that is watched.";
  static inline std::function<void(double t, double u)> seen;
  Input u = input("u", "any", "rate of change");
  State x = state("x", 0.0, "any", "the integral");
  Output y = output("y", x, "the integral");

  void rates(auto& v) const {
    v.rate(x) = v[u];
    if constexpr (std::is_same_v<std::decay_t<decltype(v.time())>, double>) {
      if (seen) seen(v.time(), v[u]);
    }
  }
};

struct EdgeCounter : Block {
  static constexpr auto summary = "Counts the edges of a signal.";
  int kind = option("direction", "rising", {"rising", "falling", "either"}, "which");
  Input u = input("u", "any", "signal");
  Held count = held("count", 0.0, "1", "number of edges");
  Output y = output("y", count, "number of edges");
  Crossing edge = crossing("edge", static_cast<Direction>(kind), "the signal passes 0");

  void crossings(auto& v) const { v[edge] = v[u]; }
  void on_crossing(Crossing, auto& v) const { v.next(count) = v[count] + 1.0; }
};

struct Exchange : Block {
  static constexpr auto summary = "Takes the other value when its trigger rises through 0.";
  Param initial = param("initial", 0.0, "any", any, "value at the start");
  Input other = input("other", "any", "value to take");
  Input trigger = input("trigger", "any", "when");
  Held value = held("value", initial, "any", "the value");
  Output y = output("y", value, "the value");
  Crossing edge = crossing("edge", Direction::rising, "the trigger rises");

  void crossings(auto& v) const { v[edge] = v[trigger]; }
  void on_crossing(Crossing, auto& v) const { v.next(value) = v[other]; }
};

/// Writes the order of its handlers as decimal digits: 1 on_sample, 2 on_time.
struct SampledSequence : Block {
  static constexpr auto summary = "Remembers which handler ran first.";
  SampleTime ts = sample_time();
  Param at = param("at", 1.0, "s", any, "time of the alarm");
  Held order = held("order", 0.0, "1", "digits, the first handler first");
  Held rung = held("rung", 0.0, "1", "1 after the alarm");
  Alarm ring = alarm("ring", "the alarm");

  void on_sample(auto& v) const { v.next(order) = 10.0 * v[order] + 1.0; }
  void schedule(auto& v) const { v[ring] = select(v.on(rung), never, v[at]); }
  void on_time(auto& v) const {
    v.next(order) = 10.0 * v[order] + 2.0;
    v.next(rung) = 1.0;
  }
};

/// The same: 2 on_time, 3 and 4 its crossings, which time passes at `root`.
struct EventSequence : Block {
  static constexpr auto summary = "Remembers which handler ran first.";
  Param at = param("at", 1.0, "s", any, "time of the alarm");
  Param root = param("root", 1.0, "s", any, "time of the crossings");
  Held order = held("order", 0.0, "1", "digits, the first handler first");
  Held rung = held("rung", 0.0, "1", "1 after the alarm");
  Crossing third = crossing("third", Direction::rising, "time passes the root");
  Crossing fourth = crossing("fourth", Direction::rising, "time passes the root");
  Alarm ring = alarm("ring", "the alarm");

  void crossings(auto& v) const {
    v[third] = v.time() - v[root];
    v[fourth] = v.time() - v[root];
  }
  void on_crossing(Crossing c, auto& v) const { v.next(order) = 10.0 * v[order] + (c == third ? 3.0 : 4.0); }
  void schedule(auto& v) const { v[ring] = select(v.on(rung), never, v[at]); }
  void on_time(auto& v) const {
    v.next(order) = 10.0 * v[order] + 2.0;
    v.next(rung) = 1.0;
  }
};

/// Compares the time of each hit with number / hits_per_second, rounded once.
struct HitCounter : Block {
  static constexpr auto summary = "Counts hits.";
  SampleTime ts = sample_time();
  Param hits_per_second = param("hits_per_second", 1.0, "1/s", positive, "inverse of the sample time");
  Held count = held("count", 0.0, "1", "number of hits");
  Held late = held("late", 0.0, "1", "number of hits at another time than that");

  void on_sample(auto& v) const {
    v.next(count) = v[count] + 1.0;
    v.next(late) = v[late] + abs(v.time() - v[count] / v[hits_per_second]);
  }
};

struct BackwardAlarm : Block {
  static constexpr auto summary = "Rings at 1 s and then asks for a time before that.";
  Param again = param("again", 0.5, "s", any, "the second time");
  Held rung = held("rung", 0.0, "1", "1 after the first alarm");
  Alarm ring = alarm("ring", "the alarm");

  void schedule(auto& v) const { v[ring] = select(v.on(rung), v[again], v.number(1.0)); }
  void on_time(auto& v) const { v.next(rung) = 1.0; }
};

struct Restless : Block {
  static constexpr auto summary = "From 1 s on changes its sign because it changed its sign.";
  Held value = held("value", 1.0, "1", "the value");
  Output y = output("y", value, "the value");
  Crossing start = crossing("start", Direction::rising, "time passes 1 s");
  Crossing flip = crossing("flip", Direction::either, "the value changes its sign");

  void crossings(auto& v) const {
    v[start] = v.time() - 1.0;
    v[flip] = v[value];
  }
  void on_crossing(Crossing, auto& v) const { v.next(value) = -v[value]; }
};

struct Lift : Block {
  static constexpr auto summary = "Sinks at 1 m/s, and is set to 1 m when it meets the ground.";
  State h = state("h", 1.0, "m", "height");
  Output y = output("y", "1", "1 while it is underground");
  Relation underground = relation("underground", "the height is negative");
  Crossing ground = crossing("ground", Direction::falling, "the height falls through 0");

  void rates(auto& v) const { v.rate(h) = v.number(-1.0); }
  void relations(auto& v) const { v[underground] = -v[h]; }
  void outputs(auto& v) const { v[y] = select(v.on(underground), v.number(1.0), v.number(0.0)); }
  void crossings(auto& v) const { v[ground] = v[h]; }
  void on_crossing(Crossing, auto& v) const { v.next(h) = 1.0; }
};

struct SampledRoot : Block {
  static constexpr auto summary = "Remembers the square root of its input at each hit.";
  SampleTime ts = sample_time();
  Input u = input("u", "any", "signal");
  Held root = held("root", 0.0, "any", "square root of the input");

  void on_sample(auto& v) const { v.next(root) = sqrt(v[u]); }
};

}  // namespace flyball::test
