#pragma once
#include "blocks/block.h"

namespace flyball {

struct DeviationPID : Block {
  static constexpr auto summary =
      "PID controller with gains for each hit: P e + I (sum of e) + D (change of e).";
  SampleTime ts = sample_time(*Rational::fraction(1, 100));
  bool sums =
      option("integral", "sum", {"sum", "printed"},
             "the sum of all errors; or, as eq. 7 of Ma et al. 2018 is printed, the present one") == 0;
  Param P = param("P", 1.0, "any", any, "gain of the error");
  Param I = param("I", 0.0, "any", any, "gain of the sum");
  Param D = param("D", 0.0, "any", any, "gain of the change since the last hit");
  Param most =
      param_if(given("sum_limit"), "sum_limit", 1.0, "any", non_negative, "greatest size of the sum");
  Param limit = param_if(given("limit"), "limit", 1.0, "any", non_negative, "greatest size of the output");
  Input e = input("e", "any", "deviation");
  Output u = output("u", "any", "control effort");
  Held total = held("sum", 0.0, "any", "sum of the errors up to the last hit");
  Held last = held("error", 0.0, "any", "error at the last hit");
  Held started = held("started", 0.0, "1", "1 after the first hit, which has no change");

  void outputs(auto& v) const {
    const auto change = v[e] - select(v.on(started), v[last], v[e]);
    v[u] = within(v, limit, v[P] * v[e] + v[I] * (sums ? sum(v) : v[e]) + v[D] * change);
  }
  void on_sample(auto& v) const {
    v.next(total) = sum(v);
    v.next(last) = v[e];
    v.next(started) = 1.0;
  }

 private:
  auto sum(auto& v) const { return within(v, most, v[total] + v[e]); }
  auto within(auto& v, Param size, const auto& x) const {
    return size.declared() ? clamp(x, -v[size], +v[size]) : x;
  }
};

}  // namespace flyball
