#include "tests/studies/fit_case.h"

#include <algorithm>
#include <limits>

#include "tests/source_dir.h"

namespace flyball::test {

FitResult FitCase::run(int threads) const {
  Evaluator evaluator(study.models);
  return run_fit(study, fit, evaluator, threads);
}

FitCase fit_case(const std::string& text, const std::string& file) {
  Diagnostics diagnostics(file);
  auto diagram = read_diagram(text, diagnostics);
  std::shared_ptr<const Plan> plan;
  if (diagram) plan = make_plan(std::make_shared<const Diagram>(*std::move(diagram)), diagnostics);
  std::string wrong;
  for (const Diagnostic& d : diagnostics.sorted()) wrong += to_string(d) + '\n';
  if (!plan) throw std::invalid_argument(wrong);
  FitCase result;
  result.study.models.push_back({"model", file, text, std::move(plan), {}, {}});
  result.fit.name = "test";
  return result;
}

FitCase shipped_fit_case(const std::string& path) {
  const std::string file = source_dir() + "/models/" + path;
  return fit_case(read_file(file), file);
}

Log reference_run(const Plan& plan, std::vector<double> times) {
  SimulationSettings settings = plan.diagram->simulation;
  settings.max_step = settings.max_step.value_or(settings.stop / 50.0);
  settings.stop = times.back();
  settings.atol *= 1e-12 / settings.rtol;
  settings.rtol = 1e-12;
  const std::shared_ptr<const Plan> shared(&plan, [](const Plan*) {});
  Simulator simulator(shared, settings, {true, EventRows::none, std::move(times)});
  simulator.run();
  return simulator.log();
}

std::vector<double> time_grid(double first, double last, int parts) {
  std::vector<double> times;
  for (int k = 0; k <= parts; ++k) times.push_back(first + (last - first) * k / parts);
  return times;
}

Sought from(const std::string& name, double start) {
  Sought sought;
  sought.name = name;
  sought.lower = -std::numeric_limits<double>::infinity();
  sought.upper = std::numeric_limits<double>::infinity();
  sought.start = start;
  return sought;
}

const FittedParameter& found(const FitResult& result, const std::string& name) {
  return *std::ranges::find(result.parameters, name, &FittedParameter::name);
}

bool remarks_contain(const FitResult& result, const std::string& text) {
  return std::ranges::any_of(result.remarks,
                             [&](const std::string& r) { return r.find(text) != std::string::npos; });
}

}  // namespace flyball::test
