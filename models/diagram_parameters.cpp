#include "models/diagram_parameters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <queue>

#include "models/diagram_expressions.h"
#include "models/language/messages.h"

namespace flyball {
namespace {

const std::vector<std::string>& parameter_keys() {
  static const std::vector<std::string> keys{"value", "unit", "range", "doc"};
  return keys;
}

bool is_value(const TomlValue& value) { return value.numeric() || value.is(TomlValue::Kind::string); }

}  // namespace

void ModelParameters::read() {
  for (const auto& subsystem : hierarchy_.all()) {
    if (const TomlValue* section = subsystem->section("parameters")) {
      for (const TomlEntry& entry : section->entries) declare(*subsystem, entry);
    }
    if (subsystem->user != nullptr) check_settings(*subsystem);
  }
  for (ParameterEntry& entry : entries_) parse(entry);
  sort();
  for (ParameterEntry& entry : entries_) settle(entry);
}

void ModelParameters::declare(Subsystem& subsystem, const TomlEntry& entry) {
  const Report& report = subsystem.report;
  ParameterEntry result;
  result.subsystem = &subsystem;
  result.reader = &subsystem;
  result.parameter.name = subsystem.prefix + entry.key;
  result.parameter.unit = "any";
  result.at = report.here(entry.at);
  if (!is_name(entry.key) || is_reserved(entry.key)) report.error(entry.at, message::not_a_name(entry.key));
  if (entry.value.is(TomlValue::Kind::table)) {
    declare_table(entry, result);
  } else if (is_value(entry.value)) {
    result.declared = &entry.value;
  } else {
    report.error(entry.value, message::wrong_type("a number, an expression or a table", entry.value));
  }
  take_value(entry, result);
  subsystem.parameters.emplace(entry.key, static_cast<int>(entries_.size()));
  entries_.push_back(std::move(result));
}

void ModelParameters::declare_table(const TomlEntry& entry, ParameterEntry& result) {
  const Report& report = result.subsystem->report;
  report.check_keys(entry.value, entry.key, parameter_keys());
  if (const TomlValue* unit = entry.value.find("unit")) {
    result.parameter.unit = report.unit(*unit).value_or("any");
    if (result.parameter.unit != "any")
      result.parameter.declared = parse_unit(result.parameter.unit).dimension;
  }
  result.parameter.doc = report.text(entry.value, "doc");
  if (const TomlValue* range = entry.value.find("range")) declare_range(*range, result);
  const TomlValue* value = entry.value.find("value");
  if (value == nullptr) return;
  if (is_value(*value)) {
    result.declared = value;
  } else {
    report.error(*value, message::wrong_type("a number or an expression", *value));
  }
}

/// What the user of a subsystem gives comes before what its declaration says.
void ModelParameters::take_value(const TomlEntry& entry, ParameterEntry& result) {
  const Subsystem& declaring = *result.subsystem;
  const TomlValue* given = declaring.user == nullptr ? nullptr : declaring.entry->value.find(entry.key);
  result.source = result.declared;
  if (given != nullptr) {
    result.reader = declaring.user;
    result.source = is_value(*given) ? given : nullptr;
    if (!is_value(*given))
      declaring.user->report.error(*given, message::wrong_type("a number or an expression", *given));
    return;
  }
  if (!entry.value.is(TomlValue::Kind::table) || entry.value.find("value") != nullptr) return;
  if (declaring.user == nullptr)
    return declaring.report.error(entry.at, message::missing_key("value", "parameter " + entry.key));
  const Report& report = declaring.user->report;
  report.error(declaring.entry->at,
               message::missing_parameter(declaring.entry->key, declaring.type.name, entry.key));
  report.note(result.at, message::declared_here(entry.key));
}

void ModelParameters::check_settings(const Subsystem& subsystem) const {
  const Report& report = subsystem.user->report;
  std::vector<std::string> known;
  for (const auto& [name, number] : subsystem.parameters) known.push_back(name);
  std::ranges::sort(known);
  for (const TomlEntry& setting : subsystem.entry->value.entries) {
    if (setting.key == "type" || subsystem.parameters.contains(setting.key)) continue;
    const std::string wrong = message::unknown_setting(setting.key, subsystem.type.name, known);
    if (setting.value.override_index >= 0) {
      report.error(setting.value, wrong);
    } else {
      report.error(setting.at, wrong);
    }
    report.note(subsystem.report.here(subsystem.type.at), message::declared_here(subsystem.type.name));
  }
}

void ModelParameters::declare_range(const TomlValue& range, ParameterEntry& result) {
  const Report& report = result.subsystem->report;
  const Expressions expressions(*this, *result.subsystem);
  if (!report.expect(range, TomlValue::Kind::list, "a range such as [0.0, 5.0]")) return;
  if (range.items.size() != 2) return report.error(range, message::range_of_two(range.items.size()));
  std::array<double, 2> ends{};
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const TomlValue& end = range.items[k];
    if (!is_value(end)) return report.error(end, message::wrong_type("a number", end));
    const auto formula = end.numeric() ? std::nullopt : expressions.formula(end, {});
    if (!end.numeric() && !formula) return;
    if (formula && !formula->operands.empty()) return report.error(end, message::range_uses_parameters());
    const auto bound = expressions.bind(end, result.parameter.unit);
    if (!bound) return;
    ends[k] = bound->value;
  }
  if (ends[0] > ends[1]) return report.error(range, message::range_reversed(ends[0], ends[1]));
  result.parameter.range = {ends[0], ends[1]};
}

void ModelParameters::parse(ParameterEntry& entry) {
  if (entry.source == nullptr || !entry.source->is(TomlValue::Kind::string)) return;
  entry.formula = Expressions(*this, *entry.reader).formula(*entry.source, {});
  if (!entry.formula) entry.source = nullptr;
}

std::vector<int> ModelParameters::operands(const ParameterEntry& entry) const {
  std::vector<int> result;
  if (!entry.formula) return result;
  for (const std::string& name : entry.formula->operands)
    result.push_back(entry.reader->find_parameter(name));
  return result;
}

std::vector<std::vector<int>> ModelParameters::uses() const {
  std::vector<std::vector<int>> result;
  result.reserve(entries_.size());
  for (const ParameterEntry& entry : entries_) result.push_back(operands(entry));
  return result;
}

/// A parameter comes behind those that it uses; else the order of the file stays.
void ModelParameters::sort() {
  const auto used = uses();
  std::vector<std::vector<int>> users(used.size());
  std::vector<std::size_t> waits(used.size());
  std::priority_queue<int, std::vector<int>, std::greater<>> ready;
  for (std::size_t k = 0; k < used.size(); ++k) {
    waits[k] = used[k].size();
    for (const int source : used[k]) users[source].push_back(static_cast<int>(k));
    if (used[k].empty()) ready.push(static_cast<int>(k));
  }
  std::vector<int> order;
  std::vector<bool> sorted(used.size());
  while (!ready.empty()) {
    const int next = ready.top();
    ready.pop();
    order.push_back(next);
    sorted[next] = true;
    for (const int user : users[next]) {
      if (--waits[user] == 0) ready.push(user);
    }
  }
  if (order.size() < used.size()) report_cycle(used, sorted);
  for (std::size_t k = 0; k < used.size(); ++k) {
    if (sorted[k]) continue;
    entries_[k].source = nullptr;
    order.push_back(static_cast<int>(k));
  }
  move_to(order);
}

void ModelParameters::move_to(const std::vector<int>& order) {
  std::vector<int> place(order.size());
  std::vector<ParameterEntry> moved;
  moved.reserve(order.size());
  for (const int k : order) {
    place[k] = static_cast<int>(moved.size());
    moved.push_back(std::move(entries_[k]));
  }
  entries_ = std::move(moved);
  for (const auto& subsystem : hierarchy_.all()) {
    for (auto& [name, number] : subsystem->parameters) number = place[number];
  }
}

/// Each unsorted parameter uses another one, so that a walk along them comes back to itself.
void ModelParameters::report_cycle(const std::vector<std::vector<int>>& uses,
                                   const std::vector<bool>& sorted) const {
  std::vector<int> seen_in(uses.size(), -1);
  for (std::size_t start = 0; start < uses.size(); ++start) {
    std::vector<int> chain;
    int at = static_cast<int>(start);
    while (!sorted[at] && seen_in[at] < 0) {
      seen_in[at] = static_cast<int>(start);
      chain.push_back(at);
      at = *std::ranges::find_if(uses[at], [&](int used) { return !sorted[used]; });
    }
    if (sorted[at] || seen_in[at] != static_cast<int>(start)) continue;
    std::vector<std::string> names;
    for (auto link = std::ranges::find(chain, at); link != chain.end(); ++link) {
      names.push_back(entries_[at].reader->local(entries_[*link].parameter.name));
    }
    names.push_back(names.front());
    entries_[at].reader->report.error(*entries_[at].source, message::cyclic_parameters(names));
  }
}

void ModelParameters::settle(ParameterEntry& entry) {
  if (entry.source == nullptr) return;
  const Expressions expressions(*this, *entry.reader);
  const std::string unit = wanted_unit(entry);
  entry.parameter.unit = unit;
  const auto binding = entry.formula ? expressions.bind(*entry.source, *entry.formula, unit)
                                     : expressions.bind(*entry.source, unit);
  if (!binding) return;
  entry.parameter.binding = *binding;
  entry.value = expressions.value(*binding);
  entry.exact = expressions.exact_value(*entry.source, entry.formula ? &*entry.formula : nullptr);
  if (entry.formula) entry.quantity = expressions.quantity(*entry.formula);
  if (unit != "any") {
    const bool hertz = entry.quantity.hertz;
    entry.quantity = Quantity(unit);
    entry.quantity.hertz = entry.quantity.hertz || hertz;
  } else if (entry.quantity.known()) {
    entry.parameter.unit = to_string(entry.quantity.dimension);
  } else {
    // Without a unit a number may mean anything.
    entry.quantity = Quantity();
  }
  entry.good = true;
  check_range(entry);
}

/// Where no unit is declared, a value from elsewhere has the dimension of the one in the declaration, if that
/// is written with a unit.
std::string ModelParameters::wanted_unit(const ParameterEntry& entry) {
  const std::string& unit = entry.parameter.unit;
  const bool from_elsewhere = entry.declared != nullptr && entry.source != entry.declared;
  if (unit == "any" && from_elsewhere && entry.declared->is(TomlValue::Kind::string)) {
    try {
      const Formula declared = parse_expression(entry.declared->text, entry.subsystem->scope);
      const Quantity quantity = infer(declared, std::vector<Quantity>(declared.operands.size()));
      if (quantity.known()) return to_string(quantity.dimension);
    } catch (const TextError&) {
      return unit;  // it is not used here
    }
  }
  return Expressions(*this, *entry.reader).wanted_unit(*entry.source, unit);
}

void ModelParameters::check_range(const ParameterEntry& entry) const {
  const Parameter& parameter = entry.parameter;
  if (parameter.range.contains(entry.value)) return;
  const Report& report = entry.reader->report;
  report.error(*entry.source,
               message::out_of_range(entry.name(), entry.value, parameter.range, parameter.unit));
  const bool elsewhere = entry.source->override_index >= 0 || entry.reader != entry.subsystem;
  if (elsewhere) report.note(entry.at, message::declared_here(entry.subsystem->local(parameter.name)));
}

void ModelParameters::mark_structural(std::vector<int> parameters) {
  while (!parameters.empty()) {
    ParameterEntry& entry = entries_[parameters.back()];
    parameters.pop_back();
    if (entry.parameter.structural) continue;
    entry.parameter.structural = true;
    // What it is computed from fixes the structure, too.
    const auto further = operands(entry);
    parameters.insert(parameters.end(), further.begin(), further.end());
  }
}

std::vector<Parameter> ModelParameters::parameters() const {
  std::vector<Parameter> result;
  for (const ParameterEntry& entry : entries_) result.push_back(entry.parameter);
  return result;
}

}  // namespace flyball
