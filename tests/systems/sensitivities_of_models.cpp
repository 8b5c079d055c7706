#include <cmath>

#include "solvers/sensitivities.h"
#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

namespace {

constexpr int samples = 20;  // compared times of a run
constexpr std::size_t most_parameters = 12;

/// Of a log of 1001 rows. Steps and hits like round numbers, and at a jump there is no derivative.
int row_of(int sample) { return 49 * sample + 3; }

/// A model over the beginning of its run: where errors grow (Lorenz), or hits are many, that must do.
Model beginning_of(const std::string& file) {
  Model model = load_model(file);
  SimulationSettings& settings = model.settings;
  settings.max_step = settings.max_step.value_or(settings.stop / 50.0);
  settings.stop = std::min(settings.stop, 3.0);
  const Rational tick = model.plan->base_tick;
  const double hits = 500.0 * static_cast<double>(tick.numerator()) / static_cast<double>(tick.denominator());
  if (!model.plan->hit_rates.empty()) settings.stop = std::min(settings.stop, hits);
  settings.log_interval.reset();
  return model;
}

/// Parameters with a number of their own that fix no structure; of many, some from everywhere in the file.
std::vector<std::string> parameters_of(const Plan& plan) {
  std::vector<std::string> all, some;
  for (const Start& literal : plan.literals) {
    const std::string name = plan.slot_name(literal.slot);
    if (plan.parameter_slot(name) != literal.slot) continue;  // a sample time
    const int p = plan.diagram->find_parameter(name);
    if (p < 0 || !plan.diagram->parameters[p].structural) all.push_back(name);
  }
  const std::size_t count = std::min(all.size(), most_parameters);
  for (std::size_t k = 0; k < count; ++k) some.push_back(all[k * all.size() / count]);
  return some;
}

SensitivityRequest request_for(const Model& model) {
  SensitivityRequest request;
  request.parameters = parameters_of(*model.plan);
  for (const LogColumn& column : model.plan->columns) request.signals.push_back(column.name);
  for (int k = 0; k < samples; ++k) request.times.push_back(model.settings.stop * row_of(k) / 1000.0);
  return request;
}

/// The logged signals at the samples, of a run on numbers; none when the value is out of its range.
std::vector<double> run_with(const Model& model, const std::string& parameter, double value) {
  SimulationSettings settings = model.settings;
  settings.method = settings.method == "bdf" ? "bdf" : "dp5";
  settings.atol *= 1e-12 / settings.rtol;
  settings.rtol = 1e-12;
  Simulator simulator(model.plan, settings, {true, EventRows::none});
  try {
    simulator.set_parameter(parameter, value);
  } catch (const std::invalid_argument&) {
    return {};
  }
  simulator.run();
  std::vector<double> rows;
  for (int k = 0; k < samples; ++k) {
    for (int c = 0; c < simulator.log().width(); ++c) rows.push_back(simulator.log().value(row_of(k), c));
  }
  return rows;
}

/// Differences over h of all signals at the samples.
struct Difference {
  std::vector<double> left, right;  // one-sided: exact but for h
  std::vector<double> bend, near;   // right - left over h and over h/2: half of it where the signal is smooth
  std::vector<double> central;      // (4 D(h/2) - D(h))/3 with central differences D: exact but for h^4
  std::vector<double> noise;        // 1e-12 of the signal over h, the tolerance of these runs
};

/// Empty where the parameter is at the end of its range.
Difference difference(const Model& model, const std::string& parameter, double value) {
  const double h = value == 0.0 ? 1e-6 : 1e-4 * std::fabs(value);
  std::vector<double> at[5];  // -h, -h/2, 0, h/2, h
  for (int k = 0; k < 5; ++k) {
    at[k] = run_with(model, parameter, value + 0.5 * h * (k - 2));
    if (at[k].empty()) return {};
  }
  Difference result;
  for (std::size_t i = 0; i < at[0].size(); ++i) {
    result.left.push_back((at[2][i] - at[0][i]) / h);
    result.right.push_back((at[4][i] - at[2][i]) / h);
    result.bend.push_back((at[4][i] - 2.0 * at[2][i] + at[0][i]) / h);
    result.near.push_back((at[3][i] - 2.0 * at[2][i] + at[1][i]) / (0.5 * h));
    const double wide = (at[4][i] - at[0][i]) / (2.0 * h), narrow = (at[3][i] - at[1][i]) / h;
    result.central.push_back((4.0 * narrow - wide) / 3.0);
    result.noise.push_back(1e-12 * std::fabs(at[2][i]) / h);
  }
  return result;
}

/// The derivatives of one signal by one parameter.
void compare(const std::vector<double>& found, const Difference& wanted, int signal, int signals) {
  double size = 0.0, noise = 0.0;
  for (int k = 0; k < samples; ++k) {
    size = std::max(size, std::fabs(found[k]));
    noise = std::max(noise, wanted.noise[k * signals + signal]);
  }
  // Both are as exact as the steps of their runs, some hundred to thousand with BDF, each within 1e-10 of a
  // derivative or within the noise of a difference; most steps add far less.
  const double tolerance = 1e-7 * size + 20.0 * noise;
  for (int k = 0; k < samples; ++k) {
    const int i = k * signals + signal;
    const double left = wanted.left[i], right = wanted.right[i];
    INFO("sample " << k << ", from the left " << left << ", from the right " << right);
    const double kink =
        std::fabs(2.0 * wanted.near[i] - wanted.bend[i]);  // moves a central difference by half
    if (kink < 0.01 * size + tolerance) {
      CHECK(std::fabs(found[k] - wanted.central[i]) <= tolerance + 0.5 * kink);
      continue;
    }
    // Not smooth: a limit that is just reached, a step on a tick, or a jump within h of the sample. The
    // derivative is that of one side, which its difference has but for h.
    const double curved = std::min(2.0 * std::fabs(wanted.bend[i] - wanted.near[i]), 0.01 * size);
    CHECK(std::min(std::fabs(found[k] - left), std::fabs(found[k] - right)) <= curved + 4.0 * tolerance);
  }
}

}  // namespace

TEST_CASE("Sensitivities of every shipped model agree with central differences") {
  int compared = 0, models = 0;
  for (const std::string& file : model_files()) {
    if (file.ends_with("diode_rectifier.toml")) continue;      // its kinks are narrower than the differences
    if (file.ends_with("smith_predictor.toml")) continue;      // derivatives do not go through delays
    if (file.ends_with("line_arc/odometry.toml")) continue;    // whole counts have none
    if (file.find("/hilare/") != std::string::npos) continue;  // nor have whole steps
    const Model model = beginning_of(file);
    const SensitivityRequest request = request_for(model);
    const int signals = static_cast<int>(request.signals.size());
    Sensitivities run(model.plan, model.settings, request);
    run.run(run.model_values());
    ++models;
    for (int p = 0; p < static_cast<int>(request.parameters.size()); ++p) {
      const Difference wanted = difference(model, request.parameters[p], run.model_values()[p]);
      if (wanted.central.empty()) continue;
      for (int s = 0; s < signals; ++s) {
        INFO(file << ": " << request.signals[s] << " by " << request.parameters[p]);
        std::vector<double> found;
        for (int k = 0; k < samples; ++k) found.push_back(run.derivative(k, s, p));
        compare(found, wanted, s, signals);
      }
      ++compared;
    }
  }
  // Parameters at the end of their range must stay the exception.
  CHECK(compared > 5 * models);
}
