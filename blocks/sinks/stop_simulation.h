#pragma once
#include "blocks/block.h"

namespace flyball {

struct StopSimulation : Block {
  static constexpr auto summary = "Ends the run when a signal is no longer 0.";
  static constexpr std::array aliases{"Modelica.Blocks.Logical.TerminateSimulation", "HALT_f"};
  std::string message = text("message", "the end was asked for", "what the summary says");
  // Halfway between the two values of a logical signal.
  Param threshold = param("threshold", 0.5, "any", any, "the run ends when the signal rises through this");
  Input u = input("u", "any", "0, and 1 when the run is to end");
  Held ended = run_end("ended", RunEnd::normal, message);
  Crossing ends = crossing("ends", Direction::rising, "the signal rises through the threshold");

  void crossings(auto& v) const { v[ends] = v[u] - v[threshold]; }
  void on_crossing(Crossing, auto& v) const { v.next(ended) = 1.0; }
};

}  // namespace flyball
