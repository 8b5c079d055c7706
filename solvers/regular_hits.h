#pragma once

#include <vector>

#include "solvers/hit_program.h"
#include "solvers/instant.h"
#include "solvers/sweep.h"

namespace flyball {

/// Instants at which nothing but sampling happens, without what Instant does for all that else may happen.
/// The same kernels run in the same order, so the numbers, and the errors, are those of Instant, bit for bit.
/// Outputs that only rates read are not computed: the next instant brings them up to date.
class RegularHits {
 public:
  RegularHits(const Plan& plan, Workspace<double>& workspace, Zeros& zeros)
      : plan_(plan),
        workspace_(workspace),
        zeros_(zeros),
        sweep_(plan, workspace, zeros),
        program_(make_hit_program(plan)) {}

  bool applies() const { return program_.applies; }
  /// Whether a logged signal may differ before and after a hit.
  bool logs_jump() const { return program_.logs_jump; }

  /// Before the first of several that follow each other, with nothing between them but steps.
  void begin();
  /// Carries out one at the time and state that the workspace holds. As long as no number is larger than
  /// `largest`, outputs that are left out are finite. Returns whether a bit changed. Throws SimulationError
  /// on what is not finite.
  bool run(const Due& due, double largest);

 private:
  void sweep(const Due& due);
  bool is_plain(double largest) const;
  void check_all();
  void hold(const Due& due);
  void throw_bad_held();
  double& next(int slot) { return workspace_.next[slot - plan_.layout.first_state]; }

  const Plan& plan_;
  Workspace<double>& workspace_;
  Zeros& zeros_;
  Sweep sweep_;
  HitProgram program_;
  Frame<double> frame_;
  bool switched_ = false;
};

}  // namespace flyball
