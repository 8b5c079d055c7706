#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "models/diagram.h"
#include "models/diagram_hierarchy.h"
#include "models/language/quantity.h"

namespace flyball {

/// A parameter of the model or of one of its subsystems.
struct ParameterEntry {
  Parameter parameter;
  Position at;                           // where it is declared
  const Subsystem* subsystem = nullptr;  // that declares it
  const TomlValue* source = nullptr;     // number or expression; nullptr when there is none that is right
  const Subsystem* reader = nullptr;     // in which `source` is read: `subsystem`, or its user
  const TomlValue* declared = nullptr;   // the value that stands in the declaration
  std::optional<Formula> formula;
  double value = 0.0;
  std::optional<Rational> exact;
  Quantity quantity;
  bool good = false;

  /// Its name in the file that gives its value.
  std::string name() const { return reader->local(parameter.name); }
};

/// All parameters of a model. One that uses others stands behind them.
class ModelParameters {
 public:
  explicit ModelParameters(const Hierarchy& hierarchy) : hierarchy_(hierarchy) {}

  void read();

  const ParameterEntry& operator[](int parameter) const { return entries_[parameter]; }
  /// The parameters, and what they are computed from, fix the structure of the diagram.
  void mark_structural(std::vector<int> parameters);
  std::vector<Parameter> parameters() const;

 private:
  void declare(Subsystem& subsystem, const TomlEntry& entry);
  void declare_table(const TomlEntry& entry, ParameterEntry& result);
  void declare_range(const TomlValue& range, ParameterEntry& result);
  void take_value(const TomlEntry& entry, ParameterEntry& result);
  void check_settings(const Subsystem& subsystem) const;
  void parse(ParameterEntry& entry);
  std::vector<int> operands(const ParameterEntry& entry) const;
  void sort();
  void move_to(const std::vector<int>& order);
  void report_cycle(const std::vector<std::vector<int>>& uses, const std::vector<bool>& sorted) const;
  std::vector<std::vector<int>> uses() const;
  void settle(ParameterEntry& entry);
  std::string wanted_unit(const ParameterEntry& entry);
  void check_range(const ParameterEntry& entry) const;

  const Hierarchy& hierarchy_;
  std::vector<ParameterEntry> entries_;
};

}  // namespace flyball
