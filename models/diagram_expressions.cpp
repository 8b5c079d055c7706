#include "models/diagram_expressions.h"

#include <algorithm>
#include <cmath>

#include "models/language/messages.h"

namespace flyball {

std::vector<int> Expressions::operands(const Formula& formula) const {
  std::vector<int> result;
  for (const std::string& name : formula.operands) result.push_back(find(name));
  return result;
}

Quantity Expressions::quantity(const Formula& formula) const {
  std::vector<Quantity> quantities;
  for (const int operand : operands(formula)) quantities.push_back(parameters_[operand].quantity);
  return infer(formula, quantities);
}

std::optional<Formula> Expressions::formula(const TomlValue& value,
                                            std::span<const std::string> inputs) const {
  try {
    Scope scope = subsystem_.scope;
    scope.inputs = inputs;
    return parse_expression(value.text, scope);
  } catch (const TextError& error) {
    subsystem_.report.error_inside(value, error.offset(), error.what());
    return std::nullopt;
  }
}

std::optional<Binding> Expressions::bind(const TomlValue& value, const std::string& unit) const {
  if (value.numeric()) {
    if (!std::isfinite(value.number)) return std::nullopt;  // the parser has said so
    Binding binding;
    binding.value = value.number;
    binding.at = subsystem_.report.here(value.at);
    return binding;
  }
  if (!value.is(TomlValue::Kind::string)) {
    subsystem_.report.error(value, message::wrong_type("a number or an expression", value));
    return std::nullopt;
  }
  const auto parsed = formula(value, {});
  return parsed ? bind(value, *parsed, wanted_unit(value, unit)) : std::nullopt;
}

std::string Expressions::wanted_unit(const TomlValue& value, const std::string& declared) const {
  if (declared != "any" || !value.replaced || !value.replaced->is(TomlValue::Kind::string)) return declared;
  try {
    const Quantity replaced = quantity(parse_expression(value.replaced->text, subsystem_.scope));
    return replaced.known() ? to_string(replaced.dimension) : declared;
  } catch (const TextError&) {
    return declared;  // what was wrong in the file is no longer there
  }
}

std::optional<Binding> Expressions::bind(const TomlValue& value, const Formula& formula,
                                         const std::string& unit) const {
  const Report& report = subsystem_.report;
  Binding binding;
  binding.at = report.here(value.at);
  binding.operands = operands(formula);
  if (!std::ranges::all_of(binding.operands, [&](int operand) { return parameters_[operand].good; }))
    return std::nullopt;
  try {
    const Quantity found = quantity(formula);
    if (const auto wrong = misfit(found, unit)) {
      report.error_inside(value, 0, *wrong);
      return std::nullopt;
    }
    if (found.known()) binding.unit = found.dimension;
  } catch (const TextError& error) {
    report.error_inside(value, error.offset(), error.what());
    return std::nullopt;
  }
  std::vector<double> values;
  for (const int operand : binding.operands) values.push_back(parameters_[operand].value);
  const double result = evaluate(formula, values);
  if (!std::isfinite(result)) {
    report.error_inside(value, 0, message::not_finite(result));
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

double Expressions::value(const Binding& binding) const {
  if (binding.kind == Binding::Kind::literal) return binding.value;
  if (binding.kind == Binding::Kind::parameter) return parameters_[binding.parameter].value;
  std::vector<double> values;
  for (const int operand : binding.operands) values.push_back(parameters_[operand].value);
  return evaluate(*binding.formula, values);
}

std::optional<double> Expressions::fixed(const TomlValue& value, const std::string& unit) const {
  const auto binding = bind(value, unit);
  if (!binding) return std::nullopt;
  if (value.is(TomlValue::Kind::string)) parameters_.mark_structural(operands(*formula(value, {})));
  return this->value(*binding);
}

std::optional<Rational> Expressions::exact_value(const TomlValue& value, const Formula* formula) const {
  if (value.is(TomlValue::Kind::integer)) return Rational(value.integer);
  if (formula == nullptr) return exact_decimal(value.text);
  std::vector<std::optional<Rational>> values;
  for (const int operand : operands(*formula)) values.push_back(parameters_[operand].exact);
  return evaluate_exact(*formula, values);
}

std::optional<Rational> Expressions::exact(const TomlValue& value, const std::string& unit) const {
  if (!fixed(value, unit)) return std::nullopt;
  const auto parsed = value.numeric() ? std::nullopt : formula(value, {});
  const auto result = exact_value(value, parsed ? &*parsed : nullptr);
  if (!result) subsystem_.report.error(value, message::not_exact(value.text));
  return result;
}

}  // namespace flyball
