#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "blocks/formula.h"
#include "models/diagram_report.h"
#include "studies/language/number_place.h"
#include "studies/language/study.h"

namespace flyball {

/// A parameter that a study names, and what it says of it.
struct NamedValue {
  std::string name;  // dotted
  Position at;
  const TomlValue* value = nullptr;
};

/// Reads what a study says of its models' parameters, and holds it against these models: names, dimensions,
/// ranges.
class SettingReader {
 public:
  SettingReader(const Report& report, Diagnostics& diagnostics, const std::vector<StudyModel>& models)
      : report_(report), diagnostics_(diagnostics), models_(models) {}

  /// The entries of a table but for keys with a meaning of their own. `motor.R = 2` without quotes is a table
  /// in a table, and is read as "motor.R".
  std::vector<NamedValue> named(const TomlValue& table, const std::vector<std::string>& reserved) const;

  /// Whether each model, as its file has it, has a setting of this name. Other structure may have more.
  bool knows(const std::string& name) const;
  /// One value of a setting; nothing where it is wrong, which is reported.
  std::optional<Setting> read(const NamedValue& given) const;
  /// All settings under the names of a table, which are then tried together on each model.
  std::vector<Setting> read_all(const std::vector<NamedValue>& given) const;
  /// Reads each model again with these settings, and reports what is wrong with them: at[k] is where
  /// settings[k] stands.
  void try_on_models(const std::vector<Setting>& settings, const std::vector<Position>& at) const;

  /// Reports names that no run can change as numbers. Empty models: all of the study.
  bool expect_number_place(const NamedValue& given, std::optional<int> model = {}) const;
  /// A number in SI for a parameter of the models: of its dimension; with `in_range`, in its range. A
  /// difference of two values has the same dimension, and no range.
  std::optional<double> number(const std::string& name, const TomlValue& value, bool in_range,
                               std::optional<int> model = {}) const;
  /// The same for a value of this unit.
  std::optional<double> quantity(const TomlValue& value, const std::string& unit) const;
  std::optional<double> above_zero(const TomlValue& value, const std::string& unit) const;

  const Report& report() const { return report_; }
  const std::vector<StudyModel>& models() const { return models_; }

 private:
  using Value = std::variant<double, std::string>;

  std::optional<Setting> read_simulation(const NamedValue& given) const;
  std::optional<Value> value_for(const StudyModel& model, const NamedValue& given) const;
  std::optional<double> checked(const Formula& formula, const TomlValue& value,
                                const std::string& unit) const;
  bool expect_in_range(const std::string& name, const TomlValue& value, double number,
                       const NumberPlace& place) const;
  bool check_method(const TomlValue& value) const;
  std::string of_model(std::string message, const StudyModel& model) const;

  const Report& report_;
  Diagnostics& diagnostics_;
  const std::vector<StudyModel>& models_;
};

/// What an override has to say for a value.
std::string as_text(const std::variant<double, std::string>& value);

}  // namespace flyball
