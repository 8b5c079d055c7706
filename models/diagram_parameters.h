#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "models/diagram.h"
#include "models/diagram_report.h"
#include "models/language/expression.h"
#include "models/language/quantity.h"

namespace flyball {

/// [parameters], and what expressions over them are worth.
class ModelParameters {
 public:
  explicit ModelParameters(Report& report) : report_(report) {}

  void read(const TomlValue& section);

  /// The binding of a number or an expression where `unit` is declared. Reports what is wrong with it;
  /// nothing then, and nothing when it uses a parameter that is wrong itself.
  std::optional<Binding> bind(const TomlValue& value, const std::string& unit);
  double value(const Binding& binding) const;

  /// The value as structure: the parameters that it uses become structural.
  std::optional<double> fixed(const TomlValue& value, const std::string& unit);
  std::optional<Rational> exact(const TomlValue& value, const std::string& unit);

  /// An expression over `inputs` and parameters. Its parameters stay parameters.
  std::optional<Formula> formula(const TomlValue& value, std::span<const std::string> inputs);

  int find(std::string_view name) const;  ///< -1 when there is none
  const std::string& name(int parameter) const { return entries_[parameter].parameter.name; }
  /// Where a parameter was declared.
  Position position(int parameter) const { return entries_[parameter].at; }
  std::vector<Parameter> parameters() const;

 private:
  struct Entry {
    Parameter parameter;
    Position at;
    const TomlValue* source = nullptr;  // number or expression
    std::optional<Formula> formula;
    double value = 0.0;
    std::optional<Rational> exact;
    Quantity quantity;
    bool good = false;
  };

  void declare(const TomlEntry& entry);
  void declare_table(const TomlEntry& entry, Entry& result);
  void declare_unit(const TomlValue& unit, Entry& result);
  void declare_range(const TomlValue& range, Entry& result);
  void sort();
  void report_cycle(const std::vector<std::vector<int>>& uses, const std::vector<bool>& sorted);
  std::vector<std::vector<int>> uses() const;
  void settle(Entry& entry);
  void check_range(const Entry& entry);
  std::string wanted_unit(const TomlValue& value, const std::string& declared) const;
  std::optional<Binding> bind(const TomlValue& value, const Formula& formula, const std::string& unit);
  std::vector<int> operands(const Formula& formula) const;
  bool all_good(std::span<const int> operands) const;
  void mark_structural(const Formula& formula);
  std::optional<Rational> exact_value(const TomlValue& value, const Formula* formula) const;

  Report& report_;
  std::vector<Entry> entries_;
  NameIndex names_;
};

}  // namespace flyball
