#include "models/diagram_parameters.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>

#include "models/language/messages.h"

namespace flyball {
namespace {

const std::vector<std::string>& parameter_keys() {
  static const std::vector<std::string> keys{"value", "unit", "range", "doc"};
  return keys;
}

bool is_value(const TomlValue& value) { return value.numeric() || value.is(TomlValue::Kind::string); }

}  // namespace

void ModelParameters::read(const TomlValue& section) {
  for (const TomlEntry& entry : section.entries) {
    names_.emplace(entry.key, static_cast<int>(entries_.size()));
    declare(entry);
  }
  for (Entry& entry : entries_) {
    if (entry.source != nullptr && entry.source->is(TomlValue::Kind::string)) {
      entry.formula = formula(*entry.source, {});
      if (!entry.formula) entry.source = nullptr;
    }
  }
  sort();
  for (Entry& entry : entries_) settle(entry);
}

void ModelParameters::declare(const TomlEntry& entry) {
  Entry result;
  result.parameter.name = entry.key;
  result.parameter.unit = "any";
  result.at = entry.at;
  if (!is_name(entry.key) || is_reserved(entry.key)) report_.error(entry.at, message::not_a_name(entry.key));
  if (entry.value.is(TomlValue::Kind::table)) {
    declare_table(entry, result);
  } else if (is_value(entry.value)) {
    result.source = &entry.value;
  } else {
    report_.error(entry.value, message::wrong_type("a number, an expression or a table", entry.value));
  }
  entries_.push_back(std::move(result));
}

void ModelParameters::declare_table(const TomlEntry& entry, Entry& result) {
  report_.check_keys(entry.value, entry.key, parameter_keys());
  if (const TomlValue* unit = entry.value.find("unit")) declare_unit(*unit, result);
  result.parameter.doc = report_.text(entry.value, "doc");
  if (const TomlValue* range = entry.value.find("range")) declare_range(*range, result);
  const TomlValue* value = entry.value.find("value");
  if (value == nullptr) {
    report_.error(entry.at, message::missing_key("value", "parameter " + entry.key));
  } else if (is_value(*value)) {
    result.source = value;
  } else {
    report_.error(*value, message::wrong_type("a number or an expression", *value));
  }
}

void ModelParameters::declare_unit(const TomlValue& unit, Entry& result) {
  if (!report_.expect(unit, TomlValue::Kind::string, "a unit in quotes")) return;
  try {
    const Unit declared = parse_unit(unit.text);
    if (!declared.si()) return report_.error(unit, message::unit_not_si(unit.text, declared.dimension));
    result.parameter.unit = unit.text;
    result.parameter.declared = declared.dimension;
  } catch (const TextError& error) {
    report_.error_inside(unit, error.offset(), error.what());
  }
}

void ModelParameters::declare_range(const TomlValue& range, Entry& result) {
  if (!report_.expect(range, TomlValue::Kind::list, "a range such as [0.0, 5.0]")) return;
  if (range.items.size() != 2) return report_.error(range, message::range_of_two(range.items.size()));
  std::array<double, 2> ends{};
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const TomlValue& end = range.items[k];
    if (!is_value(end)) return report_.error(end, message::wrong_type("a number", end));
    const auto formula = end.numeric() ? std::nullopt : this->formula(end, {});
    if (!end.numeric() && !formula) return;
    if (formula && !formula->operands.empty()) return report_.error(end, message::range_uses_parameters());
    const auto bound = bind(end, result.parameter.unit);
    if (!bound) return;
    ends[k] = bound->value;
  }
  if (ends[0] > ends[1]) return report_.error(range, message::range_reversed(ends[0], ends[1]));
  result.parameter.range = {ends[0], ends[1]};
}

std::vector<std::vector<int>> ModelParameters::uses() const {
  std::vector<std::vector<int>> result(entries_.size());
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    if (entries_[k].formula) result[k] = operands(*entries_[k].formula);
  }
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
    if (!sorted[k]) {
      entries_[k].source = nullptr;
      order.push_back(static_cast<int>(k));
    }
  }
  std::vector<Entry> moved;
  for (const int k : order) moved.push_back(std::move(entries_[k]));
  entries_ = std::move(moved);
  for (std::size_t k = 0; k < entries_.size(); ++k)
    names_.find(entries_[k].parameter.name)->second = static_cast<int>(k);
}

/// Each unsorted parameter uses another one, so that a walk along them comes back to itself.
void ModelParameters::report_cycle(const std::vector<std::vector<int>>& uses,
                                   const std::vector<bool>& sorted) {
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
      names.push_back(entries_[*link].parameter.name);
    }
    names.push_back(names.front());
    report_.error(*entries_[at].source, message::cyclic_parameters(names));
  }
}

void ModelParameters::settle(Entry& entry) {
  if (entry.source == nullptr) return;
  const std::string unit = wanted_unit(*entry.source, entry.parameter.unit);
  entry.parameter.unit = unit;
  const auto binding = entry.formula ? bind(*entry.source, *entry.formula, unit) : bind(*entry.source, unit);
  if (!binding) return;
  entry.parameter.binding = *binding;
  entry.value = value(*binding);
  entry.exact = exact_value(*entry.source, entry.formula ? &*entry.formula : nullptr);
  if (entry.formula) {
    std::vector<Quantity> quantities;
    for (const int operand : operands(*entry.formula)) quantities.push_back(entries_[operand].quantity);
    entry.quantity = infer(*entry.formula, quantities);
  }
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

void ModelParameters::check_range(const Entry& entry) {
  const Parameter& parameter = entry.parameter;
  if (parameter.range.contains(entry.value)) return;
  report_.error(*entry.source,
                message::out_of_range(parameter.name, entry.value, parameter.range, parameter.unit));
  if (entry.source->override_index >= 0) report_.note(entry.at, message::declared_here(parameter.name));
}

std::vector<Parameter> ModelParameters::parameters() const {
  std::vector<Parameter> result;
  for (const Entry& entry : entries_) result.push_back(entry.parameter);
  return result;
}

}  // namespace flyball
