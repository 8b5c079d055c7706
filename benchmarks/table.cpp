#include "benchmarks/table.h"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "benchmarks/flyball_run.h"

namespace flyball::bench {
namespace {

/// Runs shorter than this are timed several at once: the clock itself takes a microsecond.
constexpr double shortest_timing = 2e-3;

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double seconds_of(const Contender& contender, int runs) {
  const double start = cpu_seconds();
  for (int k = 0; k < runs; ++k) contender.run();
  return (cpu_seconds() - start) / runs;
}

int runs_at_once(const Contender& contender) {
  contender.run();
  const double once = seconds_of(contender, 1);
  return std::max(1, static_cast<int>(std::ceil(shortest_timing / once)));
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

std::vector<double> solve(const Contender& contender) {
  contender.run();
  return contender.result();
}

struct Tuned {
  double rtol = 0.0;
  double error = std::numeric_limits<double>::infinity();
};

/// The loosest tolerance at which the twin is as accurate as `error`, in quarters of a decade; the most
/// accurate one where rounding hides it.
Tuned equal_error(const Workload& w, const std::vector<double>& reference, double error) {
  Tuned best;
  for (int quarter = -16; quarter >= -52; --quarter) {
    const double rtol = std::pow(10.0, 0.25 * quarter);
    const double found = error_of(solve(w.twin(rtol, rtol * w.absolute_over_relative)), reference);
    if (found <= error) return {rtol, found};
    if (found < best.error) best = {rtol, found};
  }
  return best;
}

struct Comparison {
  double twin = 0.0, ours = 0.0;  // best time [s]
  double ratio = 0.0, equal_ratio = 0.0;
  double twin_error = 0.0, ours_error = 0.0, equal_rtol = 0.0;
  std::optional<double> exact;
  long rate_evaluations = 0;
};

/// In turn, so that what slows the machine down slows all of them down.
void time_in_turn(Comparison& c, const std::vector<Contender>& twin_ours_equal, int repeats) {
  std::vector<int> runs;
  for (const Contender& contender : twin_ours_equal) runs.push_back(runs_at_once(contender));
  std::vector<double> times[3], ratios, equal_ratios;
  for (int k = 0; k < repeats; ++k) {
    for (int j = 0; j < 3; ++j) times[j].push_back(seconds_of(twin_ours_equal[j], runs[j]));
    ratios.push_back(times[1].back() / times[0].back());
    equal_ratios.push_back(times[1].back() / times[2].back());
  }
  c.twin = std::ranges::min(times[0]);
  c.ours = std::ranges::min(times[1]);
  c.ratio = median(ratios);
  c.equal_ratio = median(equal_ratios);
}

Comparison compare(const Workload& w, int repeats) {
  const double atol = w.rtol * w.absolute_over_relative;
  const std::vector<double> reference =
      w.reference ? w.reference() : solve(w.twin(1e-12, 1e-12 * w.absolute_over_relative));
  const Contender twin = w.twin(w.rtol, atol), ours = w.ours(w.rtol, atol);
  Comparison c;
  c.twin_error = error_of(solve(twin), reference);
  c.ours_error = error_of(solve(ours), reference);
  const Tuned tuned = equal_error(w, reference, c.ours_error);
  c.equal_rtol = tuned.rtol;
  time_in_turn(c, {twin, ours, w.twin(tuned.rtol, tuned.rtol * w.absolute_over_relative)}, repeats);
  c.rate_evaluations = ours.rate_evaluations();
  if (w.exact_twin) {
    const Contender exact = w.exact_twin();
    c.exact = seconds_of(exact, 4 * runs_at_once(exact));
  }
  return c;
}

std::string milliseconds(double seconds) { return fmt::format("{:.3f} ms", 1e3 * seconds); }

const char* verdict(const Workload& w, double ratio) {
  return ratio <= w.aim ? "aim reached" : ratio <= w.must ? "within must" : "TOO SLOW";
}

void print_row(const Workload& w, const Comparison& c) {
  fmt::print("{:<24}{:>12}{:>12}{:>8.2f}{:>12.2f}{:>10.1e}{:>6.1f}{:>6.1f}{:>12.1e}{:>12.1e}  {}\n", w.name,
             milliseconds(c.twin), milliseconds(c.ours), c.ratio, c.equal_ratio, c.equal_rtol, w.must, w.aim,
             c.twin_error, c.ours_error, verdict(w, c.equal_ratio));
  if (c.exact) fmt::print("{:<24}{:>12}\n", "   by its exact step", milliseconds(*c.exact));
}

void print_cost_of_sections(const std::vector<Workload>& workloads,
                            const std::vector<Comparison>& comparisons) {
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (std::size_t k = 0; k < workloads.size(); ++k) {
    const Workload& w = workloads[k];
    if (w.sections < 100 || w.must < 3.0) continue;  // the stiff chain's time is that of the linear solver
    const double calls = static_cast<double>(comparisons[k].rate_evaluations);
    const double cost = 1e9 * comparisons[k].ours / (w.sections * calls);
    fmt::print("{:<24}{:>9.2f} ns a section and rate evaluation, {:.0f} evaluations\n", w.name, cost, calls);
    least = std::min(least, cost);
    most = std::max(most, cost);
  }
  if (most > 0.0) fmt::print("{:<24}{:>9.2f} dearest to cheapest, must be within 1.3\n", "", most / least);
}

}  // namespace

double error_of(const std::vector<double>& result, const std::vector<double>& reference) {
  if (result.size() != reference.size()) return std::numeric_limits<double>::infinity();
  double error = 0.0;
  for (std::size_t k = 0; k < result.size(); ++k) {
    const double distance = std::fabs(result[k] - reference[k]);
    if (!(distance <= error)) error = distance;  // keeps NaN
  }
  return error;
}

void print_comparisons(const std::vector<Workload>& workloads, int repeats) {
  fmt::print("{:<24}{:>12}{:>12}{:>8}{:>12}{:>10}{:>6}{:>6}{:>12}{:>12}\n", "workload", "twin", "Flyball",
             "ratio", "equal error", "at rtol", "must", "aim", "twin error", "our error");
  std::vector<Comparison> comparisons;
  for (const Workload& w : workloads) {
    comparisons.push_back(compare(w, repeats));
    print_row(w, comparisons.back());
    std::fflush(stdout);
  }
  print_cost_of_sections(workloads, comparisons);
}

void print_planning() {
  const std::string text = generate_chain("10000");
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const double start = cpu_seconds();
    plan_of("chain", text);
    best = std::min(best, cpu_seconds() - start);
  }
  fmt::print("{:<24}{:>24}    must be within 1 s\n", "30 002 blocks to plan", milliseconds(best));
}

}  // namespace flyball::bench
