#pragma once

#include <memory>
#include <string>

#include "benchmarks/workload.h"
#include "solvers/simulator.h"

namespace flyball::bench {

/// A plan and how to run it, as the command would: read and planned once, then any number of runs.
struct Model {
  std::shared_ptr<const Plan> plan;
  SimulationSettings settings;
  LogOptions log;
};

/// Reads and plans a text. Throws std::runtime_error with all that is wrong.
std::shared_ptr<const Plan> plan_of(const std::string& name, const std::string& text);

/// A shipped model, by its path below models/.
Model load(const std::string& path);

/// `tools/generate_chain` with these arguments.
std::string generate_chain(const std::string& arguments);

/// Each run makes a workspace and a simulator, runs to the stop time and logs into memory.
Contender contender(const Model& model, double rtol, double atol,
                    std::function<std::vector<double>(const Simulator&)> result);

/// The values of the logged columns, row by row, without time. Throws when there are not `rows` rows.
std::vector<double> logged(const Simulator& simulator, long rows);

}  // namespace flyball::bench
