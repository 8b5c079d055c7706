#include "studies/engine/run_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "models/language/messages.h"
#include "solvers/stepper.h"

namespace flyball {
namespace {

constexpr std::string_view simulation = "simulation.";

/// Plans that are kept: a sweep over structure makes any number of them.
constexpr std::size_t most_forms = 64;

void require_fitting_method(const std::string& method, const Plan& plan) {
  if (std::ranges::find(stepper_methods(), method) == stepper_methods().end())
    throw std::invalid_argument(message::unknown_method(method, stepper_methods()));
  if (method != "discrete" || plan.layout.states() == 0) return;
  std::vector<std::string> states;
  for (int k = plan.layout.first_state; k < plan.layout.first_held; ++k) states.push_back(plan.slot_name(k));
  throw std::invalid_argument(message::discrete_with_states(states));
}

double above_zero(const Setting& setting) {
  const double* value = std::get_if<double>(&setting.value);
  if (value == nullptr)
    throw std::invalid_argument(
        fmt::format("{} takes a number, not \"{}\"", setting.name, std::get<std::string>(setting.value)));
  if (*value > 0.0) return *value;
  throw std::invalid_argument(fmt::format("{} is {}, and must be above 0", setting.name, *value));
}

Rational interval(const Setting& setting) {
  const double value = above_zero(setting);
  if (const auto exact = nearest_fraction(value)) return *exact;
  throw std::invalid_argument(
      fmt::format("{} is {}, which is no exact time such as 0.01 s", setting.name, value));
}

void apply(const Setting& setting, const Plan& plan, SimulationSettings& settings) {
  const std::string_view key = std::string_view(setting.name).substr(simulation.size());
  if (key == "method") {
    const std::string* method = std::get_if<std::string>(&setting.value);
    if (method == nullptr) throw std::invalid_argument("simulation.method takes the name of a method");
    require_fitting_method(*method, plan);
    settings.method = *method;
  } else if (key == "rtol") {
    settings.rtol = above_zero(setting);
  } else if (key == "atol") {
    settings.atol = above_zero(setting);
  } else if (key == "stop") {
    settings.stop = above_zero(setting);
  } else if (key == "step") {
    settings.step = above_zero(setting);
  } else if (key == "max_step") {
    settings.max_step = above_zero(setting);
  } else if (key == "log_interval") {
    settings.log_interval = interval(setting);
  } else {
    throw std::invalid_argument(fmt::format("there is no setting {} of a simulation", setting.name));
  }
}

/// What counts of several settings of one name is the last.
std::vector<Setting> effective(std::span<const Setting> settings) {
  std::vector<Setting> result;
  for (const Setting& setting : settings) {
    const auto same = std::ranges::find(result, setting.name, &Setting::name);
    if (same == result.end()) {
      result.push_back(setting);
    } else {
      same->value = setting.value;
    }
  }
  return result;
}

std::string text_of(const Setting& setting) {
  const double* number = std::get_if<double>(&setting.value);
  return number != nullptr ? fmt::format("{}", *number) : std::get<std::string>(setting.value);
}

/// Names and values, apart by bytes that no text holds.
void append(std::string& form, const std::vector<Setting>& settings) {
  for (const Setting& setting : settings)
    form.append(setting.name).append(1, '\0').append(text_of(setting)).append(1, '\1');
  form += '\2';
}

/// Takes away those settings that belong elsewhere.
std::vector<Setting> taken(std::vector<Setting>& settings, auto&& belongs) {
  const auto rest = std::stable_partition(settings.begin(), settings.end(),
                                          [&](const Setting& setting) { return !belongs(setting); });
  std::vector<Setting> result(std::make_move_iterator(rest), std::make_move_iterator(settings.end()));
  settings.erase(rest, settings.end());
  return result;
}

/// Throws std::invalid_argument.
std::shared_ptr<const Plan> read_plan(const StudyModel& model, const std::vector<Setting>& texts) {
  std::vector<Override> overrides;
  for (const Setting& text : texts) overrides.push_back({text.name, text_of(text)});
  Diagnostics diagnostics(model.file);
  if (auto diagram = read_diagram(model.text, diagnostics, overrides)) {
    if (auto plan = make_plan(std::make_shared<const Diagram>(*std::move(diagram)), diagnostics)) return plan;
  }
  std::string error;
  for (const Diagnostic& diagnostic : diagnostics.sorted()) {
    if (diagnostic.severity != Diagnostic::Severity::error) continue;
    error += (error.empty() ? "" : "; ") + to_string(diagnostic);
  }
  throw std::invalid_argument(error);
}

void require_same_columns(const Plan& plan, const StudyModel& model) {
  const auto& names = model.plan->columns;
  if (std::ranges::equal(plan.columns, names, {}, &LogColumn::name, &LogColumn::name)) return;
  throw std::invalid_argument("with these settings the model logs other signals than as its file has it");
}

}  // namespace

/// A model with certain texts in it.
class Setups::Form {
 public:
  Form(const StudyModel& model, const std::vector<Setting>& texts) {
    try {
      plan_ = texts.empty() ? model.plan : read_plan(model, texts);
      if (!texts.empty()) require_same_columns(*plan_, model);
    } catch (const std::invalid_argument& failure) {
      error_ = failure.what();
    }
  }

  /// Throws std::invalid_argument where there is none.
  const std::shared_ptr<const Plan>& plan() const {
    if (!error_.empty()) throw std::invalid_argument(error_);
    return plan_;
  }

  /// -1 where the number cannot be set in this plan.
  int slot(const std::string& name) {
    const std::lock_guard lock(guard_);
    const auto [found, is_new] = slots_.try_emplace(name, -1);
    if (!is_new) return found->second;
    try {
      found->second = settable_parameter(*plan_, name);
    } catch (const std::invalid_argument&) {
      // It takes another plan.
    }
    return found->second;
  }

 private:
  std::shared_ptr<const Plan> plan_;
  std::string error_;
  std::mutex guard_;
  std::map<std::string, int> slots_;
};

std::shared_ptr<Setups::Form> Setups::form_of(int model, const std::vector<Setting>& texts) {
  std::string name = fmt::format("{}\2", model);
  append(name, texts);
  {
    const std::lock_guard lock(guard_);
    if (const auto known = forms_.find(name); known != forms_.end()) {
      known->second.used = ++uses_;
      return known->second.form;
    }
  }
  // Two threads may do this at the same time, with the same result.
  auto form = std::make_shared<Form>(models_[model], texts);
  const std::lock_guard lock(guard_);
  if (forms_.size() >= most_forms)
    forms_.erase(std::ranges::min_element(forms_, {}, [](const auto& kept) { return kept.second.used; }));
  return forms_.try_emplace(std::move(name), Kept{std::move(form), ++uses_}).first->second.form;
}

RunSetup Setups::make(int model, std::span<const Setting> all) {
  std::vector<Setting> numbers = effective(all);
  const auto simulated = taken(numbers, [](const Setting& s) { return s.name.starts_with(simulation); });
  auto texts = taken(numbers, [](const Setting& s) { return !std::holds_alternative<double>(s.value); });
  std::shared_ptr<Form> form;
  for (bool fits = false; !fits;) {
    form = form_of(model, texts);
    form->plan();
    const auto others = taken(numbers, [&](const Setting& number) { return form->slot(number.name) < 0; });
    texts.insert(texts.end(), others.begin(), others.end());
    fits = others.empty();
  }
  RunSetup setup{form->plan(), form->plan()->diagram->simulation, {}, fmt::format("{}\2", model)};
  for (const Setting& number : numbers)
    setup.parameters.emplace_back(form->slot(number.name), std::get<double>(number.value));
  for (const Setting& setting : simulated) apply(setting, *setup.plan, setup.settings);
  append(setup.form, texts);
  append(setup.form, simulated);
  return setup;
}

}  // namespace flyball
