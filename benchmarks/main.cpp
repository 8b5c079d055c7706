#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <string_view>

#include "benchmarks/table.h"

namespace flyball::bench {
namespace {

constexpr int repeats = 15;

std::vector<Workload> make_workloads(std::string_view filter) {
  std::vector<Workload> workloads;
  add_loop(workloads);
  add_robot(workloads);
  add_sampled(workloads);
  add_chain(workloads);
  add_events(workloads);
  add_stepper(workloads);
  add_sweep(workloads);
  add_fit(workloads);
  std::erase_if(workloads, [&](const Workload& w) { return w.name.find(filter) == std::string::npos; });
  return workloads;
}

void print_tables(std::string_view filter) {
  print_comparisons(make_workloads(filter), repeats);
  if (std::string_view("W5 sweep").find(filter) != std::string_view::npos) print_sweep_on_all_cores();
  if (std::string_view("W7 fit").find(filter) != std::string_view::npos) print_fit();
  if (filter.empty()) print_planning();
}

void repeat(benchmark::State& state, const Contender& contender) {
  for (auto _ : state) contender.run();
}

void run_benchmarks(int argc, char** argv) {
  for (const Workload& w : make_workloads("")) {
    const double atol = w.rtol * w.absolute_over_relative;
    const auto add = [&](const char* who, const auto& make) {
      const auto run = [=, rtol = w.rtol](benchmark::State& state) { repeat(state, make(rtol, atol)); };
      benchmark::RegisterBenchmark(fmt::format("{}/{}", w.name, who).c_str(), run);
    };
    add("twin", w.twin);
    add("Flyball", w.ours);
  }
  benchmark::Initialize(&argc, argv);
  if (!benchmark::ReportUnrecognizedArguments(argc, argv)) benchmark::RunSpecifiedBenchmarks();
}

}  // namespace
}  // namespace flyball::bench

/// `--table [PART]` prints the comparisons of the workloads whose name contains PART; anything else is for
/// google-benchmark.
int main(int argc, char** argv) {
  try {
    const bool table = argc > 1 && std::string_view(argv[1]) == "--table";
    if (table) {
      flyball::bench::print_tables(argc > 2 ? argv[2] : "");
    } else {
      flyball::bench::run_benchmarks(argc, argv);
    }
    return 0;
  } catch (const std::exception& failure) {
    fmt::print(stderr, "{}\n", failure.what());
    return 1;
  }
}
