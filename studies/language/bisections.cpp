#include "models/language/messages.h"
#include "models/language/names.h"
#include "studies/language/sought.h"
#include "studies/language/study_messages.h"

namespace flyball {
namespace {

using Kind = TomlValue::Kind;

class BisectionReader {
 public:
  BisectionReader(const StudyDraft& draft, const TomlEntry& entry)
      : draft_(draft), report_(draft.report()), entry_(entry), table_(entry.value) {}

  BisectDefinition read(int model) {
    result_.name = entry_.key;
    result_.model = model;
    result_.at = entry_.at;
    const TomlValue* parameter = required("parameter");
    if (parameter != nullptr &&
        report_.expect(*parameter, Kind::string, "the name of a parameter in quotes")) {
      result_.parameter = parameter->text;
      if (draft_.settings.expect_number_place({parameter->text, parameter->at, parameter}, model))
        read_range();
    }
    if (const TomlValue* requirement = required("requirement"))
      result_.requirement =
          read_name(*requirement, "requirement", names_of(draft_.study.requirements), report_);
    return result_;
  }

 private:
  const TomlValue* required(std::string_view key) {
    const TomlValue* value = table_.find(key);
    if (value == nullptr) report_.error(entry_.at, message::missing_key(key, "bisect " + entry_.key));
    return value;
  }

  void read_range() {
    const TomlValue* between = required("between");
    if (between == nullptr || !report_.expect(*between, Kind::list, "a range such as [0.0, 10.0]")) return;
    if (between->items.size() != 2)
      return report_.error(*between, message::range_of_two(between->items.size()));
    const auto lower = number(between->items[0], true), upper = number(between->items[1], true);
    if (!lower || !upper) return;
    result_.lower = *lower;
    result_.upper = *upper;
    // As fine as a table shows it.
    result_.tolerance = 1e-4 * (*upper - *lower);
    if (!(*lower < *upper)) {
      report_.error(*between, *lower == *upper ? message::bounds_equal(*lower)
                                               : message::range_reversed(*lower, *upper));
    } else if (const TomlValue* tolerance = table_.find("tolerance")) {
      read_tolerance(*tolerance);
    }
  }

  void read_tolerance(const TomlValue& value) {
    const auto tolerance = number(value, false);
    if (!tolerance) return;
    result_.tolerance = *tolerance;
    if (!(*tolerance > 0.0)) report_.error(value, message::not_above_zero(*tolerance, "1"));
  }

  std::optional<double> number(const TomlValue& value, bool in_range) const {
    return draft_.settings.number(result_.parameter, value, in_range, result_.model);
  }

  const StudyDraft& draft_;
  const Report& report_;
  const TomlEntry& entry_;
  const TomlValue& table_;
  BisectDefinition result_;
};

}  // namespace

void read_bisections(const StudyDraft& draft) {
  const TomlValue* section = draft.section("bisect");
  if (section == nullptr) return;
  for (const TomlEntry& entry : section->entries) {
    if (!draft.report().expect(entry.value, Kind::table, "a section such as [bisect.margin]")) continue;
    if (!is_name(entry.key)) draft.report().error(entry.at, message::not_a_name(entry.key));
    draft.report().check_keys(entry.value, "bisect " + entry.key,
                              {"model", "parameter", "between", "requirement", "tolerance"});
    for (const int model : read_models_of(draft, entry.value))
      draft.study.bisections.push_back(BisectionReader(draft, entry).read(model));
  }
}

}  // namespace flyball
