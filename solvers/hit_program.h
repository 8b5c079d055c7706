#pragma once

#include <vector>

#include "models/plan.h"

namespace flyball {

/// What of a plan has to run at a hit at which nothing but sampling happens: sampled blocks, what they read,
/// what is logged, and all that could go wrong there in another way than by numbers too large. What only the
/// rates read is left out: where the rates are affine, a matrix stands for it.
struct HitProgram {
  /// One sampled block that holds something.
  struct Handler {
    int rate = -1;
    const void* self = nullptr;
    Kernels<double>::Handler on_sample = nullptr;
    const int* index = nullptr;  // in Plan::index
    std::vector<int> held;       // slots
  };

  /// Whether hits of this plan can do with less than an instant: no crossings, ends of a run, loops, objects,
  /// memories of steps; relations and alarms that stand still between hits.
  bool applies = false;
  std::vector<Op> ops;                // of Plan::sweep, in its order
  std::vector<int> outputs;           // slots that `ops` write
  std::vector<int> relations;         // slots that `ops` write
  std::vector<Handler> handlers;      // by rate, in diagram order
  int first_held = 0, last_held = 0;  // slots: all that `handlers` hold is from the first to before the last
  bool logs_jump = false;             // a logged signal may jump at a hit
};

HitProgram make_hit_program(const Plan& plan);

}  // namespace flyball
