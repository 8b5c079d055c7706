#pragma once
#include "blocks/block.h"
#include "blocks/history.h"

namespace flyball {

struct TransportDelay : Block {
  static constexpr auto summary = "Shows its input a fixed time later.";
  static constexpr std::array aliases{"Modelica.Blocks.Nonlinear.FixedDelay", "TIME_DELAY"};
  Param delay = param("delay", 1.0, "s", positive, "how much later");
  Param initial = param("initial", 0.0, "any", any, "output until the input of time 0 arrives");
  Input u = input("u", "any", "signal");
  Output y = output("y", "any", "the signal, delayed");
  Held segment = held("segment", 0.0, "1", "part of the signal between two of its jumps; 0 before the first");
  Held due = held("due", 0.0, "s", "when a jump arrives, or what is known of the past would come to its end");
  Alarm arrival = alarm("arrival", "a jump of the signal arrives");
  Memory<History> past = memory<History>("past", "the signal since a delay ago");

  // The signal does not pass through within a step: no step is longer than the delay, since an alarm stands
  // at its end.
  void outputs(auto& v) const {
    v[y] = select(v.on(segment), v[past].at(v.time() - v[delay], v[segment], v[u]), v[initial]);
  }
  void on_step(auto& v) const { v[past].add(v.time(), v[u], v.time() - v[delay]); }
  void schedule(auto& v) const { v[arrival] = v[due]; }
  void on_time(auto& v) const {
    const auto arrived = v[past].segment_at(v.time(), v[delay], v[segment]);
    v.next(segment) = arrived;
    v.next(due) = min(v.time() + v[delay], v[past].end_of(v[delay], arrived));
  }
};

}  // namespace flyball
