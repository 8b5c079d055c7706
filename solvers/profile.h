#pragma once

#include <string>
#include <vector>

#include "solvers/block_times.h"
#include "solvers/zeros.h"

namespace flyball {

struct EventCounts;

/// Where a run spent its time, what happened in it, and what its steps were like.
struct Profile {
  struct Count {
    std::string name;
    long count = 0;
  };
  /// Steps that began in a part of the run.
  struct Span {
    double begin = 0.0, end = 0.0;  // s
    long steps = 0;
    double shortest = 0.0, longest = 0.0;  // s; 0 without steps
  };

  /// An estimate: calls, times the time of a call (BlockTimes). Longest first.
  std::vector<BlockTime> blocks;
  int points = 0;             // of the run at which times were measured
  double own_time = 0.0;      // of the profiler itself, s
  std::vector<Count> events;  // "crossing ball.floor", "alarm pulse.edge", "hits of pid"; most first
  std::vector<Span> spans;    // equal parts of the run
  // Steps by what chose their length: an instant or the stop time, max_step, or the method (its error).
  long until_instant = 0, at_max_step = 0, by_method = 0;
  /// Of the steps that the method chose: the state with the largest weighted error. Most first.
  std::vector<Count> limiting;
};

/// Collects a Profile, step by step.
class Profiler {
 public:
  struct Step {
    double begin, end, limit;  // s
  };

  Profiler(const Plan& plan, double stop, double max_step);

  void step(const Step& step, const Stepper<double>& stepper, const Workspace<double>& workspace);

  /// The time of the profiler itself up to now, s.
  double own_time() const { return own_time_; }
  Profile profile(const ProgramCalls& calls, const EventCounts& events, const Zeros& zeros) const;

 private:
  Profile::Span& span_at(double t);

  const Plan& plan_;
  double stop_, max_step_;
  BlockTimes times_;
  Profile steps_;               // what is known of steps so far
  std::vector<long> limiting_;  // of each state
  double own_time_ = 0.0;
};

}  // namespace flyball
