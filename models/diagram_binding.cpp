// What expressions over the parameters of a model are worth.
#include <algorithm>
#include <cmath>

#include "models/diagram_parameters.h"
#include "models/language/messages.h"

namespace flyball {

int ModelParameters::find(std::string_view name) const {
  const auto found = names_.find(name);
  return found == names_.end() ? -1 : found->second;
}

std::vector<int> ModelParameters::operands(const Formula& formula) const {
  std::vector<int> result;
  for (const std::string& name : formula.operands) result.push_back(find(name));
  return result;
}

bool ModelParameters::all_good(std::span<const int> operands) const {
  return std::ranges::all_of(operands, [&](int operand) { return entries_[operand].good; });
}

std::optional<Formula> ModelParameters::formula(const TomlValue& value, std::span<const std::string> inputs) {
  try {
    return parse_expression(value.text, Scope{&names_, inputs});
  } catch (const TextError& error) {
    report_.error_inside(value, error.offset(), error.what());
    return std::nullopt;
  }
}

std::optional<Binding> ModelParameters::bind(const TomlValue& value, const std::string& unit) {
  if (value.numeric()) {
    if (!std::isfinite(value.number)) return std::nullopt;  // the parser has said so
    Binding binding;
    binding.value = value.number;
    binding.at = value.at;
    return binding;
  }
  if (!value.is(TomlValue::Kind::string)) {
    report_.error(value, message::wrong_type("a number or an expression", value));
    return std::nullopt;
  }
  const auto parsed = formula(value, {});
  return parsed ? bind(value, *parsed, wanted_unit(value, unit)) : std::nullopt;
}

/// Where no unit is declared, an override keeps the dimension of the value that it replaces.
std::string ModelParameters::wanted_unit(const TomlValue& value, const std::string& declared) const {
  if (declared != "any" || !value.replaced || !value.replaced->is(TomlValue::Kind::string)) return declared;
  try {
    const Formula replaced = parse_expression(value.replaced->text, Scope{&names_, {}});
    std::vector<Quantity> quantities;
    for (const int operand : operands(replaced)) quantities.push_back(entries_[operand].quantity);
    const Quantity quantity = infer(replaced, quantities);
    return quantity.known() ? to_string(quantity.dimension) : declared;
  } catch (const TextError&) {
    return declared;  // what was wrong in the file is no longer there
  }
}

std::optional<Binding> ModelParameters::bind(const TomlValue& value, const Formula& formula,
                                             const std::string& unit) {
  Binding binding;
  binding.at = value.at;
  binding.operands = operands(formula);
  if (!all_good(binding.operands)) return std::nullopt;
  try {
    std::vector<Quantity> quantities;
    for (const int operand : binding.operands) quantities.push_back(entries_[operand].quantity);
    const Quantity found = infer(formula, quantities);
    if (const auto wrong = misfit(found, unit)) {
      report_.error_inside(value, 0, *wrong);
      return std::nullopt;
    }
    if (found.known()) binding.unit = found.dimension;
  } catch (const TextError& error) {
    report_.error_inside(value, error.offset(), error.what());
    return std::nullopt;
  }
  std::vector<double> values;
  for (const int operand : binding.operands) values.push_back(entries_[operand].value);
  const double result = evaluate(formula, values);
  if (!std::isfinite(result)) {
    report_.error_inside(value, 0, message::not_finite(result));
    return std::nullopt;
  }
  if (formula.operands.empty()) {
    binding.value = result;
  } else if (formula.nodes.back().op == Formula::Op::operand) {
    binding.kind = Binding::Kind::parameter;
    binding.parameter = binding.operands[0];
    binding.operands.clear();
  } else {
    binding.kind = Binding::Kind::formula;
    binding.formula = std::make_shared<const Formula>(formula);
  }
  // What is computed from parameters has the units that they bring along.
  if (binding.kind != Binding::Kind::literal) binding.unit.reset();
  return binding;
}

double ModelParameters::value(const Binding& binding) const {
  if (binding.kind == Binding::Kind::literal) return binding.value;
  if (binding.kind == Binding::Kind::parameter) return entries_[binding.parameter].value;
  std::vector<double> values;
  for (const int operand : binding.operands) values.push_back(entries_[operand].value);
  return evaluate(*binding.formula, values);
}

void ModelParameters::mark_structural(const Formula& formula) {
  std::vector<int> pending = operands(formula);
  while (!pending.empty()) {
    Entry& entry = entries_[pending.back()];
    pending.pop_back();
    if (entry.parameter.structural) continue;
    entry.parameter.structural = true;
    // What it is computed from fixes the structure, too.
    if (!entry.formula) continue;
    const auto further = operands(*entry.formula);
    pending.insert(pending.end(), further.begin(), further.end());
  }
}

std::optional<double> ModelParameters::fixed(const TomlValue& value, const std::string& unit) {
  const auto binding = bind(value, unit);
  if (!binding) return std::nullopt;
  if (value.is(TomlValue::Kind::string)) mark_structural(*formula(value, {}));
  return this->value(*binding);
}

std::optional<Rational> ModelParameters::exact_value(const TomlValue& value, const Formula* formula) const {
  if (value.is(TomlValue::Kind::integer)) return Rational(value.integer);
  if (formula == nullptr) return exact_decimal(value.text);
  std::vector<std::optional<Rational>> values;
  for (const int operand : operands(*formula)) values.push_back(entries_[operand].exact);
  return evaluate_exact(*formula, values);
}

std::optional<Rational> ModelParameters::exact(const TomlValue& value, const std::string& unit) {
  if (!fixed(value, unit)) return std::nullopt;
  const auto parsed = value.numeric() ? std::nullopt : formula(value, {});
  const auto result = exact_value(value, parsed ? &*parsed : nullptr);
  if (!result) report_.error(value, message::not_exact(value.text));
  return result;
}

}  // namespace flyball
