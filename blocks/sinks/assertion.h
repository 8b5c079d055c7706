#pragma once
#include "blocks/block.h"

namespace flyball {

struct Assertion : Block {
  static constexpr auto summary = "Stops the run with an error when a condition fails.";
  std::string message = text("message", "the assertion failed", "what the error says");
  // Halfway between the two values of a logical signal.
  Param threshold = param("threshold", 0.5, "any", any, "the condition holds while the signal is above this");
  Input u = input("u", "any", "the condition: 1 while it holds, 0 when it fails");
  Held failed = run_end("failed", RunEnd::error, message);
  Crossing fails = crossing("fails", Direction::falling, "the signal falls through the threshold");

  void crossings(auto& v) const { v[fails] = v[u] - v[threshold]; }
  void on_crossing(Crossing, auto& v) const { v.next(failed) = 1.0; }
};

}  // namespace flyball
