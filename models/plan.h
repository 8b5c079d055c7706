#pragma once

#include <any>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "models/diagram.h"
#include "models/sparsity.h"

namespace flyball {

/// Where each kind of number stands in the value array of a run:
/// time | parameters | states | held values | outputs | relations | crossings | alarms.
struct Layout {
  int first_state = 0;
  int first_held = 0;
  int first_output = 0;
  int first_relation = 0;
  int first_crossing = 0;
  int first_alarm = 0;
  int size = 0;
  int objects = 0;
  int memories = 0;

  int states() const { return first_held - first_state; }
  int staged() const { return first_output - first_state; }
  int relations() const { return first_crossing - first_relation; }
  int crossings() const { return first_alarm - first_crossing; }
  int alarms() const { return size - first_alarm; }
};

/// One call of a kernel: `count` instances of one object, whose index maps stand one after the other.
struct Op {
  const BlockObject* object = nullptr;
  const void* self = nullptr;  // the block, as its kernels expect it
  Phase phase = Phase::outputs;
  Kernels<double>::Sweep on_double = nullptr;
  Kernels<Jet>::Sweep on_jet = nullptr;
  int first = 0;   // index map of the first instance, in Plan::index
  int stride = 0;  // slots of the object
  int count = 0;
  int place = 0;         // of the first instance, in Plan::placed
  int rate = -1;         // of sampled blocks: only run at this rate's hits
  int settle_first = 0;  // relations whose bits settle after this call: Program::settle
  int settle_count = 0;
};

/// Calls `first` to `last` - 1 of a program need each other's results at the same time: Plan::loops.
struct LoopSpan {
  int first = 0;
  int last = 0;
  int loop = -1;
};

/// Calls `first` to `last` - 1 are run again until the bits that they read are those that their results give.
struct ModeSpan {
  int first = 0;
  int last = 0;
  int settle_first = 0;  // Program::settle
  int settle_count = 0;
  int chain = -1;  // Plan::chains
};

/// What is run, in order.
struct Program {
  std::vector<Op> ops;
  std::vector<int> settle;  // slots of relations
  std::vector<LoopSpan> loops;
  std::vector<ModeSpan> modes;
};

/// An algebraic loop. Its tears are guessed; the calls of its span then compute the other members, and the
/// tears once more, which must not differ from the guess.
struct Loop {
  struct Tear {
    int slot = -1;
    int rate = -1;  // of sampled blocks: stands still but at this rate's hits
  };
  /// After a call, the output that is a tear holds what was computed: the guess goes back to its place.
  struct Return {
    int op = 0;  // counted from the first call of the span
    int tear = -1;
    bool final = false;  // all that the tear reads is known by now
  };
  std::vector<Tear> tears;
  bool guessed = false;         // the model says where to look for the solution
  std::vector<Return> returns;  // in the order of calls
  std::vector<int> slots;       // all numbers that its calls read or write
  bool affine = true;           // as long as bits and held values stand still
  int chain = -1;               // Plan::chains
};

/// One way round an algebraic loop, as users are told.
struct Chain {
  int begins = -1;   // instance
  std::string text;  // "sum.y -> k.u -> k.y -> sum.u2 -> sum.y"
};

/// Sampled blocks that share period and offset: hit k is at tick offset + k * period of the base tick.
struct Rate {
  Rational period, offset;
  std::int64_t period_ticks = 1;
  std::int64_t offset_ticks = 0;
  std::vector<int> handlers;  // instances with on_sample, in diagram order
};

struct CrossingRecord {
  int instance = -1;
  int local = -1;  // slot of the block
  Direction direction = Direction::either;
};

struct AlarmRecord {
  int instance = -1;
  int slot = -1;
};

/// A parameter that is computed from others.
struct Derivation {
  int slot = -1;
  const Formula* formula = nullptr;
  std::vector<int> operands;  // slots
};

/// A number that a run starts with: literal, or the value of another slot.
struct Start {
  int slot = -1;
  double value = 0.0;
  int from = -1;
};

struct LogColumn {
  std::string name;
  std::string unit;
  int slot = -1;
};

/// How to run a diagram: slots, order, programs. Immutable; any number of runs on any number of threads share
/// one.
struct Plan {
  std::shared_ptr<const Diagram> diagram;
  Layout layout;

  std::vector<int> index;        // the index maps: local slot to slot, one instance after the other
  std::vector<int> map;          // of each instance of the diagram: where its index map begins
  std::vector<int> placed;       // instances in the order of their index maps
  std::vector<int> owner;        // of each slot: instance (-1: time, parameter of the model)
  std::vector<int> owner_local;  // of each slot: slot of the block (parameter number without owner)

  std::vector<int> model_slots;         // of each parameter of the model
  std::vector<Start> literals;          // parameters with a number of their own
  std::vector<Derivation> derivations;  // in dependency order
  std::vector<Start> initial;           // states and held values
  std::vector<int> streams;             // slots of streams of random numbers
  std::vector<int> run_ends;            // slots of held values that end the run when they are not 0
  std::vector<std::function<std::shared_ptr<const void>()>> first_objects;
  std::vector<std::any (*)()> first_memories;

  // Programs. A bit is read in all, and settled in `sweep` only.
  Program sweep;               // everything, for instants
  Program rates;               // minor steps: the cone of the rates, then the rates
  Program rates_only;          // just the rates, after a sweep
  Program zeros;               // the cone of unsampled relations and crossings, then these
  Program zeros_rest;          // what of `zeros` is missing after `rates` at the same point
  Program logs;                // the cone of the logged signals
  Program crossings;           // just the crossings, after a sweep
  Program schedules;           // all alarms
  Program steps;               // the cone of what blocks with on_step read, then these
  std::vector<int> externals;  // slots that `rates` reads and does not write, but for states and parameters
  std::vector<Chain> chains;   // of each algebraic loop, those that only bits close included
  std::vector<Loop> loops;     // of all programs
  std::vector<int> switches;   // relations and held values that blocks of these programs read as their own
  std::vector<int> frozen;     // all of both, and what `zeros` and `logs` read or give and do not write

  Rational base_tick = Rational(1);
  std::vector<Rate> hit_rates;
  std::vector<int> rate_of;                      // of each instance; -1: not sampled
  std::vector<CrossingRecord> crossing_records;  // crossing k has slot first_crossing + k
  std::vector<AlarmRecord> alarm_records;        // alarm k has slot first_alarm + k
  std::vector<int> located_relations;            // slots of relations of unsampled blocks
  std::vector<LogColumn> columns;

  Sparsity pattern;  // of the Jacobian of the rates; contains the diagonal
  Colouring colouring;

  const int* index_of(int instance) const { return index.data() + map[instance]; }
  const Instance& instance(int i) const { return diagram->instances[i]; }
  /// "plant.y", "K_gamma", "time".
  std::string slot_name(int slot) const;
  /// The slot of a parameter of the model or of a subsystem ("K_gamma", "motor.R"), or of "block.parameter"
  /// ("motor.winding.gain"); -1 when there is none.
  int parameter_slot(std::string_view name) const;
};

/// Plans a checked diagram. Algebraic loops that cannot be solved, and sample times without a common tick,
/// are reported to `diagnostics`; then the result is empty.
std::shared_ptr<const Plan> make_plan(std::shared_ptr<const Diagram> diagram, Diagnostics& diagnostics);

}  // namespace flyball
