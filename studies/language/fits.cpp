#include <algorithm>
#include <cerrno>
#include <cstring>

#include "models/diagram_files.h"
#include "models/language/csv.h"
#include "models/language/messages.h"
#include "models/language/names.h"
#include "models/read_file.h"
#include "studies/language/model_findings.h"
#include "studies/language/sought.h"
#include "studies/language/study_messages.h"

namespace flyball {
namespace {

using Kind = TomlValue::Kind;

std::vector<std::string> logged(const StudyModel& model) {
  std::vector<std::string> names;
  for (const LogColumn& column : model.plan->columns) names.push_back(column.name);
  return names;
}

class ExperimentReader {
 public:
  ExperimentReader(const StudyDraft& draft, const TomlValue& table, int model)
      : draft_(draft), report_(draft.report()), table_(table), model_(draft.study.models[model]) {}

  FitExperiment read(std::size_t number) {
    report_.check_keys(table_, "an experiment", {"name", "data", "match", "set"});
    result_.name = report_.text(table_, "name");
    if (result_.name.empty()) result_.name = std::to_string(number + 1);
    if (const TomlValue* data = table_.find("data")) read_data(*data);
    if (const TomlValue* match = table_.find("match")) read_match(*match);
    if (table_.find("data") != nullptr && table_.find("match") == nullptr)
      report_.error(table_, message::nothing_to_match(result_.name));
    if (const TomlValue* set = table_.find("set");
        set != nullptr && report_.expect(*set, Kind::table, "a table such as { load = \"2 N*m\" }")) {
      result_.settings = draft_.settings.read_all(draft_.settings.named(*set, {}));
    }
    return result_;
  }

 private:
  void read_data(const TomlValue& data) {
    if (!report_.expect(data, Kind::string, "the name of a file in quotes")) return;
    result_.data = path_beside(report_.file(), data.text);
    errno = 0;
    const auto content = read_file_content(result_.data, largest_csv);
    if (!content) return report_.error(data, message::unreadable_file(result_.data, std::strerror(errno)));
    Diagnostics found(result_.data);
    csv_ = read_csv(*content, found);
    for (const Diagnostic& problem : found.sorted())
      report_.error(data, message::in_data_file(to_string(problem)));
  }

  void read_match(const TomlValue& match) {
    if (!report_.expect(match, Kind::table, "a table such as { y = \"column\" }")) return;
    for (const NamedValue& given : matched(match)) {
      FitExperiment::Match one;
      one.signal = given.name;
      const auto known = logged(model_);
      if (std::ranges::find(known, one.signal) == known.end())
        report_.error(given.at, message::no_such_thing("logged signal", one.signal, known));
      if (read_column(*given.value, one)) result_.matches.push_back(one);
    }
  }

  /// Signals have dots, too: `motor.speed = "w"` without quotes is a table in a table.
  std::vector<NamedValue> matched(const TomlValue& match) const {
    std::vector<NamedValue> result;
    const auto add = [&](auto& self, const std::string& prefix, const TomlEntry& entry) -> void {
      const bool part = entry.value.is(Kind::table) && entry.value.find("column") == nullptr;
      if (!part) return result.push_back({prefix + entry.key, entry.at, &entry.value});
      for (const TomlEntry& inner : entry.value.entries) self(self, prefix + entry.key + '.', inner);
    };
    for (const TomlEntry& entry : match.entries) add(add, "", entry);
    return result;
  }

  bool read_column(const TomlValue& value, FitExperiment::Match& match) {
    const TomlValue* column = &value;
    if (value.is(Kind::table)) {
      report_.check_keys(value, match.signal, {"column", "weight"});
      column = value.find("column");
      if (const TomlValue* weight = value.find("weight"))
        match.weight = draft_.settings.above_zero(*weight, "1").value_or(1.0);
    }
    if (!report_.expect(*column, Kind::string, "the name of a column in quotes")) return false;
    match.column = column->text;
    if (!csv_ || csv_->find(match.column) >= 0) return true;
    std::vector<std::string> names;
    for (const CsvTable::Column& known : csv_->columns) names.push_back(known.name);
    report_.error_inside(*column, 0, message::no_such_thing("column", match.column, names));
    return false;
  }

  const StudyDraft& draft_;
  const Report& report_;
  const TomlValue& table_;
  const StudyModel& model_;
  std::optional<CsvTable> csv_;
  FitExperiment result_;
};

void read_options(const StudyDraft& draft, const TomlValue& table, FitDefinition& fit) {
  const Report& report = draft.report();
  read_word(table, "loss", {"squared", "huber", "cauchy", "soft_l1"}, fit.loss, report);
  read_word(table, "gradient", {"exact", "numeric"}, fit.gradient, report);
  if (const TomlValue* scale = table.find("loss_scale"))
    fit.loss_scale = draft.settings.above_zero(*scale, "any").value_or(1.0);
  fit.starts = static_cast<int>(read_count(table, "starts", fit.starts, 10'000, report));
  fit.max_iterations =
      static_cast<int>(read_count(table, "max_iterations", fit.max_iterations, 1'000'000, report));
}

FitDefinition read_fit(const StudyDraft& draft, const TomlEntry& entry, int model) {
  const Report& report = draft.report();
  const TomlValue& table = entry.value;
  FitDefinition fit;
  fit.name = entry.key;
  fit.model = model;
  fit.at = entry.at;
  if (const TomlValue* parameters = table.find("parameters")) {
    fit.parameters = read_sought(draft, *parameters, model, true);
  } else {
    report.error(entry.at, message::missing_key("parameters", "fit " + entry.key));
  }
  if (const TomlValue* experiments = table.find("experiments");
      experiments != nullptr && report.expect(*experiments, Kind::list, "a list of tables")) {
    for (const TomlValue& one : experiments->items) {
      if (report.expect(one, Kind::table, "a table such as { data = \"step.csv\", match = { y = \"y\" } }"))
        fit.experiments.push_back(ExperimentReader(draft, one, model).read(fit.experiments.size()));
    }
  }
  if (const TomlValue* names = table.find("requirements"))
    fit.requirements = read_names(*names, "requirement", names_of(draft.study.requirements), report);
  if (const TomlValue* names = table.find("minimise"))
    fit.minimise = read_names(*names, "metric", names_of(draft.study.metrics), report);
  if (!lists_something(table, {"experiments", "requirements", "minimise"}))
    report.error(entry.at, message::nothing_to_fit());
  read_options(draft, table, fit);
  return fit;
}

}  // namespace

void read_fits(const StudyDraft& draft) {
  const TomlValue* section = draft.section("fit");
  if (section == nullptr) return;
  for (const TomlEntry& entry : section->entries) {
    if (!draft.report().expect(entry.value, Kind::table, "a section such as [fit.reference]")) continue;
    if (!is_name(entry.key)) draft.report().error(entry.at, message::not_a_name(entry.key));
    draft.report().check_keys(entry.value, "fit " + entry.key,
                              {"model", "parameters", "experiments", "requirements", "minimise", "loss",
                               "loss_scale", "starts", "gradient", "max_iterations"});
    for (const int model : read_models_of(draft, entry.value))
      draft.study.fits.push_back(read_fit(draft, entry, model));
  }
}

}  // namespace flyball
