#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "studies/language/study.h"

namespace flyball::test {

/// x' = -x / T + noise, from x0: a first-order lag with a sampled disturbance, and what it costs.
inline constexpr const char* lag_model = R"(flyball = 1
[parameters]
T = { value = 0.5, unit = "s", range = [0.01, 100.0] }
x0 = 1.0
deviation = 0.0
period = "0.1 s"
[blocks]
noise = { type = "RandomNumber", deviation = "deviation", sample_time = "period" }
sum = { type = "Sum", signs = "+-" }
rate = { type = "Gain", gain = "1/T" }
x = { type = "Integrator", initial = "x0" }
square = { type = "Product" }
cost = { type = "Integrator" }
[diagram]
wires = ["noise -> sum.u1", "x -> sum.u2", "sum -> rate -> x", "x -> square.u1", "x -> square.u2", "square -> cost"]
log = ["x", "cost"]
[simulation]
stop = "1 s"
log_interval = "0.1 s"
)";

/// A model as a study has it.
inline StudyModel study_model(const std::string& text, const std::vector<std::string>& metrics = {},
                              const std::vector<std::string>& requirements = {}) {
  StudyModel model{"lag", "lag.toml", text, nullptr, {}, {}};
  Diagnostics diagnostics(model.file);
  if (auto diagram = read_diagram(text, diagnostics))
    model.plan = make_plan(std::make_shared<const Diagram>(*std::move(diagram)), diagnostics);
  if (!model.plan) throw std::invalid_argument(to_string(diagnostics.sorted().at(0)));
  for (const std::string& metric : metrics) model.metrics.emplace_back(metric, model.plan->columns);
  for (const std::string& requirement : requirements)
    model.requirements.emplace_back(requirement, model.plan->columns, ".");
  return model;
}

}  // namespace flyball::test
