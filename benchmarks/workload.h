#pragma once

#include <functional>
#include <string>
#include <vector>

namespace flyball::bench {

/// A program that solves a workload. Repeated runs do the same work.
struct Contender {
  std::function<void()> run;                    // what is timed: from a model in memory to a result in memory
  std::function<std::vector<double>()> result;  // of the last run, in the order of the reference
  std::function<long()> rate_evaluations;       // of the last run; ours only
};

/// A problem, our way to solve it and the best that can be written for it by hand.
struct Workload {
  std::string name;
  double must = 0.0;  // largest ratio of the times, ours to the twin's
  double aim = 0.0;
  double rtol = 1e-6;
  double absolute_over_relative = 1e-2;  // atol / rtol
  std::function<Contender(double rtol, double atol)> twin;
  std::function<Contender(double rtol, double atol)> ours;
  std::function<std::vector<double>()> reference;  // closed form, or the twin at tolerance 1e-12
  std::function<Contender()> exact_twin;           // for information, where each step is a closed form
  int sections = 0;                                // of a chain
};

/// Largest distance from the reference.
double error_of(const std::vector<double>& result, const std::vector<double>& reference);

void add_loop(std::vector<Workload>& workloads);
void add_robot(std::vector<Workload>& workloads);
void add_sampled(std::vector<Workload>& workloads);
void add_chain(std::vector<Workload>& workloads);
void add_events(std::vector<Workload>& workloads);
void add_stepper(std::vector<Workload>& workloads);
void add_fit(std::vector<Workload>& workloads);
void add_sweep(std::vector<Workload>& workloads);

}  // namespace flyball::bench
