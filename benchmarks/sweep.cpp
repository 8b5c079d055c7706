#include <fmt/format.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <thread>

#include "benchmarks/dopri5.h"
#include "benchmarks/flyball_run.h"
#include "benchmarks/table.h"
#include "solvers/lane_simulator.h"
#include "solvers/parameters.h"
#include "studies/engine/run_study.h"
#include "studies/file.h"

namespace flyball::bench {
namespace {

constexpr int runs = 10000;
constexpr double stop = 10.0, step_time = 1.0;

struct Gains {
  double Kp, Ki, Kd, wn;
};

Gains gains(int i) {
  return {2.0 + 0.8 * (i % 10), 1.0 + 0.6 * (i / 10 % 10), 0.5 + 0.3 * (i / 100 % 10),
          1.0 + 0.2 * (i / 1000 % 10)};
}

/// The loop of loop.cpp with gains. States: integral, filtered error, v, y, integral of the squared error.
struct SweptLoop {
  using State = std::array<double, 5>;
  Gains k;
  double reference = 0.0;

  void operator()(double, const State& x, State& dx) const {
    const double error = reference - x[3];
    const double d = 50.0 * (k.Kd * error - x[1]);
    const double effort = std::min(5.0, std::max(-5.0, k.Kp * error + x[0] + d));
    dx[0] = k.Ki * error;
    dx[1] = d;
    dx[2] = k.wn * k.wn * (effort - x[3]) - 0.6 * k.wn * x[2];
    dx[3] = x[2];
    dx[4] = error * error;
  }
};

double squared_error(int run, double rtol, double atol) {
  Dopri5<5, SweptLoop> solver(SweptLoop{gains(run)}, rtol, atol, 1e-3, stop);
  for (const double end : {step_time, stop}) {
    solver.restart(solver.end(), solver.state());
    while (solver.step(end) < end) {
    }
    solver.rates.reference = 1.0;
  }
  return solver.state()[4];
}

Contender twin(double rtol, double atol) {
  auto last = std::make_shared<std::vector<double>>(runs);
  Contender result;
  result.run = [=] {
    for (int i = 0; i < runs; ++i) (*last)[i] = squared_error(i, rtol, atol);
  };
  result.result = [=] { return *last; };
  return result;
}

struct Sweep {
  Model model;
  std::vector<ParameterSet> sets;
  int cost = -1;  // slot
};

Sweep load_sweep() {
  Sweep sweep;
  sweep.model = load("benchmarks/sweep.toml");
  const Plan& plan = *sweep.model.plan;
  const auto slot = [&](const char* name) { return settable_parameter(plan, name); };
  for (int i = 0; i < runs; ++i) {
    const Gains k = gains(i);
    sweep.sets.push_back({{slot("Kp"), k.Kp}, {slot("Ki"), k.Ki}, {slot("Kd"), k.Kd}, {slot("wn"), k.wn}});
  }
  sweep.cost = std::ranges::find(plan.columns, "cost", &LogColumn::name)->slot;
  return sweep;
}

std::vector<double> costs(const Sweep& sweep, const std::vector<LaneOutcome>& outcomes) {
  std::vector<double> result;
  for (const LaneOutcome& outcome : outcomes) {
    if (!outcome.error.empty()) throw std::runtime_error(outcome.error);
    result.push_back(outcome.values[sweep.cost]);
  }
  return result;
}

Contender in_lanes(double rtol, double atol, const LaneOptions& options) {
  auto sweep = std::make_shared<Sweep>(load_sweep());
  sweep->model.settings.rtol = rtol;
  sweep->model.settings.atol = atol;
  auto last = std::make_shared<std::vector<double>>();
  Contender result;
  result.run = [=] {
    *last = costs(*sweep, run_in_lanes(sweep->model.plan, sweep->model.settings, sweep->sets, options));
  };
  result.result = [=] { return *last; };
  result.rate_evaluations = [] { return 0L; };
  return result;
}

Contender one_by_one(double rtol, double atol) {
  auto sweep = std::make_shared<Sweep>(load_sweep());
  sweep->model.settings.rtol = rtol;
  sweep->model.settings.atol = atol;
  auto last = std::make_shared<std::vector<double>>();
  Contender result;
  result.run = [=] {
    last->clear();
    for (int i = 0; i < runs; ++i) {
      const Gains k = gains(i);
      Simulator simulator(sweep->model.plan, sweep->model.settings, {.enabled = false});
      simulator.set_parameter("Kp", k.Kp);
      simulator.set_parameter("Ki", k.Ki);
      simulator.set_parameter("Kd", k.Kd);
      simulator.set_parameter("wn", k.wn);
      simulator.run();
      last->push_back(simulator.workspace().values[sweep->cost]);
    }
  };
  result.result = [=] { return *last; };
  result.rate_evaluations = [] { return 0L; };
  return result;
}

/// Where a study is kept while it is measured.
class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / fmt::format("flyball-sweep-{}", ::getpid())) {}
  ~Folder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const std::filesystem::path& empty() const {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directory(path_);
    return path_;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The sweep as people run it: from a study in memory to all its runs in the store of its folder.
Contender as_study(double rtol, double atol, int threads) {
  Diagnostics diagnostics(FLYBALL_SOURCE_DIR "/studies/benchmarks/sweep.toml");
  auto study =
      std::make_shared<std::optional<Study>>(read_study(flyball::read_file(diagnostics.file()), diagnostics));
  if (!*study) throw std::runtime_error(to_string(diagnostics.sorted().at(0)));
  (*study)->scenarios[0].settings = {{"simulation.rtol", rtol}, {"simulation.atol", atol}};
  auto folder = std::make_shared<Folder>();
  Contender result;
  result.run = [=] {
    StudyOptions options;
    options.folder = folder->empty();
    options.threads = threads;
    if (!run_study(**study, options, {}).complete()) throw std::runtime_error("the study is not complete");
  };
  result.result = [=] {
    std::vector<double> costs;
    Store(store_file(folder->path()), Store::Mode::read).read(0, runs, [&](const StoredRun& run) {
      costs.push_back(run.record.metrics.at(0));
    });
    return costs;
  };
  result.rate_evaluations = [] { return 0L; };
  return result;
}

Workload workload(const std::string& name, std::function<Contender(double, double)> ours) {
  Workload w;
  w.name = name;
  w.must = 4.0;
  w.aim = 1.2;
  w.twin = twin;
  w.ours = std::move(ours);
  return w;
}

struct Times {
  double wall = 0.0, processor = 0.0;  // [s]
};

Times times_of(const std::function<void()>& work) {
  const auto processor = [] {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  };
  const auto start = std::chrono::steady_clock::now();
  const double before = processor();
  work();
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
          processor() - before};
}

}  // namespace

void add_sweep(std::vector<Workload>& workloads) {
  workloads.push_back(
      workload("W5 sweep, lanes", [](double rtol, double atol) { return in_lanes(rtol, atol, {}); }));
  workloads.push_back(workload("W5 sweep, baseline lanes", [](double rtol, double atol) {
    return in_lanes(rtol, atol, {.isa = Isa::baseline});
  }));
  workloads.push_back(workload("W5 sweep, one by one", one_by_one));
  workloads.push_back(
      workload("W5 sweep, as a study", [](double rtol, double atol) { return as_study(rtol, atol, 1); }));
}

void print_sweep_on_all_cores() {
  const int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const Times hand = times_of([&] {
    std::vector<std::jthread> workers;
    for (int k = 0; k < threads; ++k) {
      workers.emplace_back([=] {
        for (int i = k; i < runs; i += threads) squared_error(i, 1e-6, 1e-8);
      });
    }
  });
  const Contender ours = in_lanes(1e-6, 1e-8, {.threads = threads});
  const Times lanes = times_of(ours.run);
  fmt::print(
      "{:<24}twin {:.3f} s, {:.3f} s of processors; Flyball {:.3f} s, "
      "{:.3f} s of processors\n",
      fmt::format("W5 on {} cores", threads), hand.wall, hand.processor, lanes.wall, lanes.processor);
  const Times one = times_of(as_study(1e-6, 1e-8, 1).run);
  const Times all = times_of(as_study(1e-6, 1e-8, threads).run);
  fmt::print("{:<24}one thread {:.3f} s, {} threads {:.3f} s: {:.2f} times as fast\n", "W5 as a study",
             one.wall, threads, all.wall, one.wall / all.wall);
}

}  // namespace flyball::bench
