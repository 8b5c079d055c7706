#pragma once
#include <algorithm>

#include "blocks/block.h"

namespace flyball {

struct RepeatingSequence : Block {
  static constexpr auto summary = "Values at given times, again and again.";
  static constexpr bool lockstep = false;  // each run is at a row of its own
  bool interpolates = option("interpolation", "linear", {"linear", "hold"}, "between two times") == 0;
  Coefficients given_times =
      coefficients("times", {0.0, 2.0}, "s", "times, rising; the last one ends the period");
  Coefficients given_values = coefficients("values", {0.0, 2.0}, "any", "value at each of the times");
  std::vector<Param> times = given_times.params(0), values = given_values.params(0);
  int last = static_cast<int>(times.size()) - 1;
  Output y = output("y", "any", "the value; the first one before the first time");
  // The piece that is on now. Periods are counted, not added up.
  Held start = held("start", front(times), "s", "time at which this piece began");
  Held value = held("value", front(values), "any", "value at that time");
  Held slope = held("slope", 0.0, "any", "change per second in this piece");
  Held due = held("due", front(times), "s", "time of the next piece");
  Held next = held("next", 0.0, "1", "number of the next piece in its period");
  Held periods = held("periods", 0.0, "1", "number of the period of the next piece");
  Alarm kink = alarm("kink", "the next piece begins");

  explicit RepeatingSequence(Settings* settings) : Block(settings) {
    if (times.size() < 2) refuse("times", "expected at least two times");
    if (times.size() != values.size()) {
      refuse("values", "expected " + std::to_string(times.size()) + " values, one for each time, found " +
                           std::to_string(values.size()));
    }
  }

  void schedule(auto& v) const { v[kink] = v[due]; }
  void on_time(auto& v) const {
    const int k = std::clamp(index_of(v[next]), 0, last - 1), following = k + 1 < last ? k + 1 : 0;
    const auto period = following == 0 ? v[periods] + 1.0 : v[periods];
    v.next(start) = v[due];
    v.next(value) = v.number(values[k]);
    v.next(slope) = interpolates ? change(v, values, k) / change(v, times, k) : v[slope];
    v.next(due) = v.number(times[following]) + period * (v.number(times[last]) - v.number(times[0]));
    v.next(next) = static_cast<double>(following);
    v.next(periods) = period;
  }
  void outputs(auto& v) const { v[y] = v[value] + v[slope] * (v.time() - v[start]); }

 private:
  static Param front(const std::vector<Param>& all) { return all.empty() ? Param{} : all[0]; }
  static auto change(auto& v, const std::vector<Param>& of, int k) {
    return v.number(of[k + 1]) - v.number(of[k]);
  }
};

}  // namespace flyball
