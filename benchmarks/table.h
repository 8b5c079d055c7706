#pragma once

#include <vector>

#include "benchmarks/workload.h"

namespace flyball::bench {

/// Prints one row a workload: twin and Flyball in turn, `repeats` times each (at least 9), in processor time
/// of this thread. Times are the best of all repeats, ratios the median of the pairs. "equal error" compares
/// with the twin at the loosest tolerance at which it is as accurate as Flyball.
void print_comparisons(const std::vector<Workload>& workloads, int repeats);

/// Prints the time of W5 on all cores, by the clock and of the processors.
void print_sweep_on_all_cores();

/// Prints how many simulations the fits of W7 take, and how far from the truth they end.
void print_fit();

/// Prints how long a chain of 10 000 sections takes from text to plan.
void print_planning();

}  // namespace flyball::bench
