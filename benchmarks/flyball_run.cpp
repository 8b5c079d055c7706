#include "benchmarks/flyball_run.h"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>

namespace flyball::bench {
namespace {

std::string read_file(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string all_of(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& d : diagnostics.sorted()) text += to_string(d) + "\n";
  return text;
}

}  // namespace

std::shared_ptr<const Plan> plan_of(const std::string& name, const std::string& text) {
  Diagnostics diagnostics(name);
  std::optional<Diagram> diagram = read_diagram(text, diagnostics);
  if (!diagram) throw std::runtime_error(all_of(diagnostics));
  auto plan = make_plan(std::make_shared<const Diagram>(std::move(*diagram)), diagnostics);
  if (!plan) throw std::runtime_error(all_of(diagnostics));
  return plan;
}

Model load(const std::string& path) {
  const std::string file = std::string(FLYBALL_SOURCE_DIR "/models/") + path;
  Model model;
  model.plan = plan_of(file, read_file(file));
  model.settings = model.plan->diagram->simulation;
  model.log.event_rows = EventRows::none;
  return model;
}

std::string generate_chain(const std::string& arguments) {
  const std::string command = FLYBALL_SOURCE_DIR "/tools/generate_chain " + arguments;
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
  std::string text;
  std::array<char, 65536> buffer;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    text.append(buffer.data(), n);
  if (pclose(pipe) != 0) throw std::runtime_error(command + " failed");
  return text;
}

Contender contender(const Model& model, double rtol, double atol,
                    std::function<std::vector<double>(const Simulator&)> result) {
  Model with_tolerance = model;
  with_tolerance.settings.rtol = rtol;
  with_tolerance.settings.atol = atol;
  auto last = std::make_shared<std::unique_ptr<Simulator>>();
  Contender ours;
  ours.run = [last, m = std::move(with_tolerance)] {
    last->reset();
    *last = std::make_unique<Simulator>(m.plan, m.settings, m.log);
    (*last)->run();
  };
  ours.result = [last, result = std::move(result)] { return result(**last); };
  ours.rate_evaluations = [last] { return (*last)->statistics().stepper.rate_evaluations; };
  return ours;
}

std::vector<double> logged(const Simulator& simulator, long rows) {
  const Log& log = simulator.log();
  if (log.rows() != rows) throw std::runtime_error(fmt::format("{} rows, expected {}", log.rows(), rows));
  std::vector<double> values;
  for (long r = 0; r < rows; ++r) {
    for (int c = 0; c < log.width(); ++c) values.push_back(log.value(r, c));
  }
  return values;
}

}  // namespace flyball::bench
