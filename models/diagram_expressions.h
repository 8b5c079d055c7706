#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "models/diagram_parameters.h"

namespace flyball {

/// What the expressions of one subsystem are worth, over the parameters that it sees.
class Expressions {
 public:
  Expressions(ModelParameters& parameters, const Subsystem& subsystem)
      : parameters_(parameters), subsystem_(subsystem) {}

  /// The binding of a number or an expression where `unit` is declared. Reports what is wrong with it;
  /// nothing then, and nothing when it uses a parameter that is wrong itself.
  std::optional<Binding> bind(const TomlValue& value, const std::string& unit) const;
  std::optional<Binding> bind(const TomlValue& value, const Formula& formula, const std::string& unit) const;
  double value(const Binding& binding) const;

  /// The value as structure: the parameters that it uses become structural.
  std::optional<double> fixed(const TomlValue& value, const std::string& unit) const;
  std::optional<Rational> exact(const TomlValue& value, const std::string& unit) const;
  /// Nothing where the value has no exact one; `formula` is that of a text.
  std::optional<Rational> exact_value(const TomlValue& value, const Formula* formula) const;

  /// An expression over `inputs` and parameters. Its parameters stay parameters.
  std::optional<Formula> formula(const TomlValue& value, std::span<const std::string> inputs) const;

  int find(std::string_view name) const { return subsystem_.find_parameter(name); }
  std::vector<int> operands(const Formula& formula) const;
  /// The quantity of a formula whose operands are known. Throws TextError.
  Quantity quantity(const Formula& formula) const;
  /// Where no unit is declared, an override keeps the dimension of the value that it replaces.
  std::string wanted_unit(const TomlValue& value, const std::string& declared) const;

  const ParameterEntry& parameter(int number) const { return parameters_[number]; }
  const Subsystem& subsystem() const { return subsystem_; }

 private:
  ModelParameters& parameters_;
  const Subsystem& subsystem_;
};

}  // namespace flyball
