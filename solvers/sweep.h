#pragma once

#include <vector>

#include "solvers/workspace.h"
#include "solvers/zeros.h"

namespace flyball {

/// The sweep of an instant: every block in sorted order, bits settled right before what reads them.
class Sweep {
 public:
  Sweep(const Plan& plan, Workspace<double>& workspace, Zeros& zeros)
      : plan_(plan), workspace_(workspace), zeros_(zeros) {}

  /// `hits` tells which rates hit; null: only unsampled blocks run. Throws SimulationError where a loop has
  /// no solution, or its bits no consistent mode.
  void run(const std::vector<unsigned char>* hits);

 private:
  using Hits = const std::vector<unsigned char>*;
  void run(int first, int last, Hits hits);
  void call_all(int first, int last, Hits hits);
  void settle(const ModeSpan& span, Hits hits);
  [[noreturn]] void throw_no_mode(const ModeSpan& span, const std::vector<int>& unsettled) const;

  const Plan& plan_;
  Workspace<double>& workspace_;
  Zeros& zeros_;
};

}  // namespace flyball
