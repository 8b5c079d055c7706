#pragma once

#include <memory>
#include <vector>

#include "models/plan.h"

namespace flyball {

/// What solving the loops of a run keeps: factors of their Jacobians from one solution to the next, and room
/// to work in. It belongs to a workspace, and a copy goes on with the same bits.
class LoopMemory {
 public:
  LoopMemory();
  ~LoopMemory();
  LoopMemory(const LoopMemory& other);
  LoopMemory& operator=(const LoopMemory& other);
  LoopMemory(LoopMemory&&) noexcept;
  LoopMemory& operator=(LoopMemory&&) noexcept;

  struct Numbers;
  /// Made at the first solution.
  Numbers& numbers(const Plan& plan);

 private:
  std::unique_ptr<Numbers> numbers_;
};

/// Where a loop stands: its calls, and which rates hit (null: none, as during a step).
struct LoopCall {
  const Plan& plan;
  const Program& program;
  const LoopSpan& span;
  const std::vector<unsigned char>* hits = nullptr;
};

/// The greatest difference between a guess and what it gives, relative to it where it is above 1.
inline constexpr double loop_tolerance = 1e-10;

/// Solves a loop from the tears that the frame holds; leaves all its members there, consistent within
/// `loop_tolerance` and mostly within rounding. Bits stand still. Throws SimulationError: algebraic_loop with
/// the chain where there is no solution or no single one, not_finite where the first guess leads to no
/// number.
void solve_loop(const LoopCall& call, const Frame<double>& frame, LoopMemory& memory);

/// The same with derivatives: the solution on numbers, then one Newton step for the derivatives.
void solve_loop(const LoopCall& call, const Frame<Jet>& frame, LoopMemory& memory);

}  // namespace flyball
