#include "studies/language/setting_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "blocks/rational.h"
#include "models/language/expression.h"
#include "models/language/messages.h"
#include "models/language/quantity.h"
#include "solvers/stepper.h"
#include "studies/language/model_findings.h"
#include "studies/language/study_messages.h"

namespace flyball {
namespace {

using Kind = TomlValue::Kind;

constexpr std::string_view simulation = "simulation.";

/// The number or text as an override would say it.
std::string written(const TomlValue& value) {
  if (value.is(Kind::boolean)) return value.flag ? "true" : "false";
  return value.is(Kind::integer) ? std::to_string(value.integer) : value.text;
}

bool is_constant(const Formula& formula) { return formula.operands.empty(); }

}  // namespace

std::string as_text(const std::variant<double, std::string>& value) {
  const auto* number = std::get_if<double>(&value);
  return number != nullptr ? fmt::format("{}", *number) : std::get<std::string>(value);
}

std::vector<NamedValue> SettingReader::named(const TomlValue& table,
                                             const std::vector<std::string>& reserved) const {
  std::vector<NamedValue> result;
  const auto names_parameter = [&](const std::string& name) {
    return std::ranges::any_of(
        models_, [&](const StudyModel& model) { return model.plan->parameter_slot(name) >= 0; });
  };
  const auto names_part = [&](const std::string& name) {
    return name + '.' == simulation || std::ranges::any_of(models_, [&](const StudyModel& model) {
             const auto inside = [&](const Instance& i) { return i.name.starts_with(name + '.'); };
             return model.plan->diagram->find_instance(name) >= 0 ||
                    std::ranges::any_of(model.plan->diagram->instances, inside);
           });
  };
  const auto add = [&](auto& self, const std::string& prefix, const TomlEntry& entry) -> void {
    const std::string name = prefix + entry.key;
    if (!entry.value.is(Kind::table) || names_parameter(name) || !names_part(name)) {
      result.push_back({name, entry.at, &entry.value});
      return;
    }
    for (const TomlEntry& inner : entry.value.entries) self(self, name + '.', inner);
  };
  for (const TomlEntry& entry : table.entries) {
    if (std::ranges::find(reserved, entry.key) == reserved.end()) add(add, "", entry);
  }
  return result;
}

std::optional<Setting> SettingReader::read(const NamedValue& given) const {
  if (given.name.starts_with(simulation)) return read_simulation(given);
  if (!given.value->numeric() && !given.value->is(Kind::string) && !given.value->is(Kind::boolean)) {
    report_.error(*given.value, message::wrong_type("a number or a text", *given.value));
    return std::nullopt;
  }
  std::optional<Value> merged;
  for (const StudyModel& model : models_) {
    auto value = value_for(model, given);
    if (!value) return std::nullopt;
    // What is a number to one model and a formula to another one is a text to both.
    merged = !merged || merged == value ? std::move(value) : Value(written(*given.value));
  }
  if (!merged) return std::nullopt;
  return Setting{given.name, *std::move(merged)};
}

std::optional<SettingReader::Value> SettingReader::value_for(const StudyModel& model,
                                                             const NamedValue& given) const {
  const TomlValue& value = *given.value;
  const Diagram& diagram = *model.plan->diagram;
  const auto place = number_place(*model.plan, given.name);
  if (place && value.is(Kind::boolean)) {
    report_.error(value, message::wrong_type("a number or an expression", value));
    return std::nullopt;
  }
  if (!place && diagram.find_parameter(given.name) < 0) return written(value);
  if (value.is(Kind::boolean) || (!place && value.numeric())) return written(value);
  try {
    const NameIndex names = visible_parameters(diagram, given.name);
    const auto formula = value.numeric()
                             ? std::nullopt
                             : std::optional(parse_expression(value.text, Scope{&names, {}, nullptr}));
    if (!place || (formula && !is_constant(*formula))) return written(value);
    const auto number = formula ? checked(*formula, value, place->unit) : std::optional(value.number);
    if (!number || !expect_in_range(given.name, value, *number, *place)) return std::nullopt;
    return *number;
  } catch (const TextError& error) {
    report_.error_inside(value, error.offset(), of_model(error.what(), model));
    return std::nullopt;
  }
}

/// Throws TextError.
std::optional<double> SettingReader::checked(const Formula& formula, const TomlValue& value,
                                             const std::string& unit) const {
  if (const auto wrong = misfit(infer(formula, {}), unit)) {
    report_.error_inside(value, 0, *wrong);
    return std::nullopt;
  }
  const double number = evaluate(formula, {});
  if (std::isfinite(number)) return number;
  report_.error_inside(value, 0, message::not_finite(number));
  return std::nullopt;
}

bool SettingReader::expect_in_range(const std::string& name, const TomlValue& value, double number,
                                    const NumberPlace& place) const {
  if (place.range.contains(number)) return true;
  // Numbers that are not finite were reported by the parser.
  if (std::isfinite(number))
    report_.error(value, message::out_of_range(name, number, place.range, place.unit));
  return false;
}

bool SettingReader::knows(const std::string& name) const {
  return name.starts_with(simulation) || std::ranges::all_of(models_, [&](const StudyModel& model) {
           return model.plan->parameter_slot(name) >= 0 || is_structure(*model.plan, name);
         });
}

std::vector<Setting> SettingReader::read_all(const std::vector<NamedValue>& given) const {
  std::vector<Setting> settings;
  std::vector<Position> places;
  for (const NamedValue& one : given) {
    if (std::ranges::find(settings, one.name, &Setting::name) != settings.end()) {
      report_.error(one.at, message::set_twice(one.name));
      continue;
    }
    auto setting = read(one);
    if (!setting) continue;
    settings.push_back(*std::move(setting));
    places.push_back(knows(one.name) ? one.value->at : one.at);
  }
  if (settings.size() == given.size()) try_on_models(settings, places);
  return settings;
}

void SettingReader::try_on_models(const std::vector<Setting>& settings,
                                  const std::vector<Position>& at) const {
  std::vector<PlacedOverride> placed;
  std::vector<Override> overrides;
  for (std::size_t k = 0; k < settings.size(); ++k) {
    if (settings[k].name.starts_with(simulation)) continue;
    overrides.push_back({settings[k].name, as_text(settings[k].value)});
    placed.push_back({overrides.back(), at[k]});
  }
  if (overrides.empty()) return;
  for (const StudyModel& model : models_) {
    Diagnostics found(model.file);
    if (auto diagram = read_diagram(model.text, found, overrides))
      make_plan(std::make_shared<const Diagram>(*std::move(diagram)), found);
    if (found.failed())
      take_findings(found, {placed.front().at, model.name, models_.size() > 1}, diagnostics_, placed);
  }
}

bool SettingReader::expect_number_place(const NamedValue& given, std::optional<int> model) const {
  for (std::size_t m = 0; m < models_.size(); ++m) {
    if (model && static_cast<int>(m) != *model) continue;
    const Plan& plan = *models_[m].plan;
    if (number_place(plan, given.name)) continue;
    const bool exists = plan.parameter_slot(given.name) >= 0 || is_structure(plan, given.name);
    std::string wrong = exists ? message::no_number_place(given.name)
                               : message::unknown_parameter(given.name, number_places(plan));
    report_.error(given.at, of_model(std::move(wrong), models_[m]));
    return false;
  }
  return true;
}

std::optional<double> SettingReader::number(const std::string& name, const TomlValue& value, bool in_range,
                                            std::optional<int> model) const {
  std::optional<double> result;
  for (std::size_t m = 0; m < models_.size(); ++m) {
    if (model && static_cast<int>(m) != *model) continue;
    const auto place = number_place(*models_[m].plan, name);
    if (!place) return std::nullopt;
    result = quantity(value, place->unit);
    if (!result) return std::nullopt;
    if (in_range && !expect_in_range(name, value, *result, *place)) return std::nullopt;
  }
  return result;
}

std::optional<double> SettingReader::quantity(const TomlValue& value, const std::string& unit) const {
  if (value.numeric()) return std::isfinite(value.number) ? std::optional(value.number) : std::nullopt;
  if (!report_.expect(value, Kind::string, "a number, or one with its unit in quotes")) return std::nullopt;
  try {
    return checked(parse_expression(value.text, Scope{}), value, unit);
  } catch (const TextError& error) {
    report_.error_inside(value, error.offset(), error.what());
    return std::nullopt;
  }
}

std::optional<double> SettingReader::above_zero(const TomlValue& value, const std::string& unit) const {
  const auto number = quantity(value, unit);
  if (!number || *number > 0.0) return number;
  report_.error(value, message::not_above_zero(*number, unit));
  return std::nullopt;
}

std::optional<Setting> SettingReader::read_simulation(const NamedValue& given) const {
  static const std::vector<std::pair<std::string, std::string>> units{
      {"stop", "s"}, {"log_interval", "s"}, {"max_step", "s"}, {"step", "s"}, {"rtol", "1"}, {"atol", "1"}};
  const std::string key = given.name.substr(simulation.size());
  if (key == "method") {
    if (!check_method(*given.value)) return std::nullopt;
    return Setting{given.name, given.value->text};
  }
  const auto known = std::ranges::find(units, key, &std::pair<std::string, std::string>::first);
  if (known == units.end()) {
    std::vector<std::string> names{"method"};
    for (const auto& [name, unit] : units) names.push_back(name);
    report_.error(given.at, message::unknown_key(key, "[simulation] of a study", names));
    return std::nullopt;
  }
  const auto number = above_zero(*given.value, known->second);
  if (!number) return std::nullopt;
  if (key == "log_interval" && !nearest_fraction(*number)) {
    report_.error(*given.value, message::not_exact(written(*given.value)));
    return std::nullopt;
  }
  return Setting{given.name, *number};
}

bool SettingReader::check_method(const TomlValue& value) const {
  if (!report_.expect(value, Kind::string, "the name of a method in quotes")) return false;
  std::vector<std::string> methods = stepper_methods();
  methods.insert(methods.begin(), "auto");
  if (std::ranges::find(methods, value.text) == methods.end()) {
    report_.error_inside(value, 0, message::unknown_method(value.text, methods));
    return false;
  }
  for (const StudyModel& model : models_) {
    const Layout& layout = model.plan->layout;
    if (value.text != "discrete" || layout.states() == 0) continue;
    std::vector<std::string> states;
    for (int k = 0; k < layout.states(); ++k) states.push_back(model.plan->slot_name(layout.first_state + k));
    report_.error_inside(value, 0, of_model(message::discrete_with_states(states), model));
    return false;
  }
  return true;
}

std::string SettingReader::of_model(std::string message, const StudyModel& model) const {
  return models_.size() > 1 ? message::in_model(message, model.name) : message;
}

}  // namespace flyball
