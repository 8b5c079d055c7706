#pragma once
#include "blocks/block.h"

namespace flyball {

struct Delay : Block {
  static constexpr auto summary = "Delays its input by a number of sample times.";
  static constexpr std::array aliases{"REGISTER", "REGISTER_f"};
  SampleTime ts = sample_time();
  int length = count("length", 2, 1, 10000, "number of sample times");
  bool each = given("initial_values");
  Param initial = param_if(!each, "initial", 0.0, "any", any, "output at the first hits");
  Coefficients initials = coefficients("initial_values", {}, "any",
                                       "outputs at the first hits, in their order, instead of `initial`");
  Input u = input("u", "any", "signal");
  Output y = each ? output("y", "any", "the signal so many hits before")
                  : output("y", "any", "the signal so many hits before", initial);
  Helds line = helds("line", start(), "any", "the signal: line1 is the output at the next hit");

  explicit Delay(Settings* settings) : Block(settings) {
    if (!each || initials.columns() == length) return;
    refuse("initial_values", "expected " + std::to_string(length) + " numbers, as many as `length`, found " +
                                 std::to_string(initials.columns()));
  }

  void outputs(auto& v) const { v[y] = v[line[0]]; }
  void on_sample(auto& v) const {
    for (int k = 0; k + 1 < length; ++k) v.next(line[k]) = v[line[k + 1]];
    v.next(line[length - 1]) = v[u];
  }

 private:
  std::vector<Param> start() const {
    std::vector<Param> all = each ? initials.params(0) : std::vector<Param>(length, initial);
    all.resize(length);
    return all;
  }
};

}  // namespace flyball
