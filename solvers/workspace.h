#pragma once

#include <any>
#include <cstdint>
#include <memory>
#include <vector>

#include "blocks/jet.h"
#include "models/plan.h"
#include "solvers/algebraic_loop.h"
#include "solvers/stepper.h"

namespace flyball {

/// Every number of one run. A copy is a checkpoint: it holds indices and values, no pointers into itself or
/// into the run that it came from.
template <class T>
struct Workspace {
  explicit Workspace(const Plan& plan);

  /// What AffineProgram has learned of a program.
  struct Affine {
    std::vector<double> matrix, slope, offset;  // matrix by rows
    std::vector<double> switches;               // Plan::switches at that time
    bool stale = true;
  };

  std::vector<T> values;            // Plan::layout tells what stands where
  std::vector<T> next;              // staged states and held values
  std::vector<unsigned char> bits;  // of relations
  std::vector<signed char> sides;   // of crossings: -1, 1, 0 as long as it is not known
  std::vector<std::int64_t> ticks;  // of each rate: base tick of its next hit
  std::vector<std::shared_ptr<const void>> objects;
  std::vector<std::shared_ptr<const void>> next_objects;
  std::vector<std::any> memories;
  Affine rates_map, zeros_map, logs_map;
  StepMemory step;
  LoopMemory loops;
  std::int64_t log_position = 0;  // number of the next asked log time
};

/// The arrays of one run, and what its algebraic loops are solved with.
template <class T>
struct RunFrame : Frame<T> {
  LoopMemory* loops = nullptr;
};

/// The arrays as kernels see them; `rates` may be null where no rates are asked for.
template <class T>
RunFrame<T> frame(const Plan& plan, Workspace<T>& workspace, T* rates = nullptr) {
  RunFrame<T> f;
  f.values = workspace.values.data();
  f.rates = rates;
  f.next = workspace.next.data();
  f.bits = workspace.bits.data();
  f.first_state = plan.layout.first_state;
  f.first_relation = plan.layout.first_relation;
  f.objects = workspace.objects.data();
  f.next_objects = workspace.next_objects.data();
  f.memories = workspace.memories.data();
  f.loops = &workspace.loops;
  return f;
}

inline void call(const Op& op, const Plan& plan, const Frame<double>& f) {
  op.on_double(op.self, f, plan.index.data() + op.first, op.stride, op.count);
}
inline void call(const Op& op, const Plan& plan, const Frame<Jet>& f) {
  op.on_jet(op.self, f, plan.index.data() + op.first, op.stride, op.count);
}

/// Runs a program without hits: minor steps, logs, zeros, schedules.
template <class T>
void run(const Program& program, const Plan& plan, const RunFrame<T>& f) {
  std::size_t done = 0;
  for (const LoopSpan& span : program.loops) {
    for (; done < static_cast<std::size_t>(span.first); ++done) call(program.ops[done], plan, f);
    solve_loop({plan, program, span}, f, *f.loops);
    done = span.last;
  }
  for (; done < program.ops.size(); ++done) call(program.ops[done], plan, f);
}

/// Writes parameters and initial values, clears bits, sides and hits. Throws SimulationError (not_finite)
/// when a derived parameter or an initial value is not finite.
template <class T>
void initialise(const Plan& plan, Workspace<T>& workspace);

/// Gives a Jet workspace the numbers and bits of another one, without derivatives.
void lift(const Workspace<double>& from, Workspace<Jet>& to);

/// Gives each noise block its own random numbers.
template <class T>
void seed(const Plan& plan, Workspace<T>& workspace, std::uint64_t number);

/// Recomputes derived parameters after a parameter was set.
template <class T>
void derive(const Plan& plan, Workspace<T>& workspace);

}  // namespace flyball
