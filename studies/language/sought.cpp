#include "studies/language/sought.h"

#include <algorithm>

#include "models/language/messages.h"
#include "studies/language/study_messages.h"

namespace flyball {
namespace {

using Kind = TomlValue::Kind;

class SoughtReader {
 public:
  SoughtReader(const StudyDraft& draft, const NamedValue& given, int model)
      : settings_(draft.settings), report_(draft.report()), given_(given), model_(model) {
    sought_.name = given.name;
    sought_.lower = -infinity;
    sought_.upper = infinity;
  }

  std::optional<Sought> read() {
    const TomlValue& value = *given_.value;
    if (!settings_.expect_number_place(given_, model_)) return std::nullopt;
    if (value.is(Kind::string)) return sought_;  // a name alone, of a list
    if (value.is(Kind::list)) return read_bounds(value) ? std::optional(sought_) : std::nullopt;
    if (!report_.expect(value, Kind::table, "bounds such as [0.0, 10.0], or { range, start, scale }"))
      return std::nullopt;
    report_.check_keys(value, given_.name, {"range", "start", "scale"});
    const TomlValue* range = value.find("range");
    if (range != nullptr && !read_bounds(*range)) return std::nullopt;
    const TomlValue* start = value.find("start");
    if (start != nullptr && !read_start(*start)) return std::nullopt;
    const TomlValue* scale = value.find("scale");
    return scale == nullptr || read_scale(*scale) ? std::optional(sought_) : std::nullopt;
  }

 private:
  bool read_bounds(const TomlValue& list) {
    if (!report_.expect(list, Kind::list, "bounds such as [0.0, 10.0]")) return false;
    if (list.items.size() != 2) {
      report_.error(list, message::range_of_two(list.items.size()));
      return false;
    }
    const auto lower = settings_.number(given_.name, list.items[0], true, model_);
    const auto upper = settings_.number(given_.name, list.items[1], true, model_);
    if (!lower || !upper) return false;
    sought_.lower = *lower;
    sought_.upper = *upper;
    if (*lower < *upper) return true;
    report_.error(list,
                  *lower == *upper ? message::bounds_equal(*lower) : message::range_reversed(*lower, *upper));
    return false;
  }

  bool read_start(const TomlValue& value) {
    sought_.start = settings_.number(given_.name, value, true, model_);
    if (!sought_.start) return false;
    if (*sought_.start >= sought_.lower && *sought_.start <= sought_.upper) return true;
    report_.error(value, message::start_outside(*sought_.start, sought_.lower, sought_.upper));
    return false;
  }

  bool read_scale(const TomlValue& value) {
    const auto scale = settings_.number(given_.name, value, false, model_);
    if (!scale) return false;
    sought_.scale = *scale;
    if (*scale > 0.0) return true;
    report_.error(value, message::not_above_zero(*scale, "1"));
    return false;
  }

  const SettingReader& settings_;
  const Report& report_;
  const NamedValue& given_;
  int model_;
  Sought sought_;
};

}  // namespace

std::vector<Sought> read_sought(const StudyDraft& draft, const TomlValue& parameters, int model, bool open) {
  std::vector<Sought> result;
  std::vector<NamedValue> given;
  const Report& report = draft.report();
  if (parameters.is(Kind::table)) {
    given = draft.settings.named(parameters, {});
  } else if (open && parameters.is(Kind::list)) {
    for (const TomlValue& item : parameters.items) {
      if (report.expect(item, Kind::string, "the name of a parameter in quotes"))
        given.push_back({item.text, item.at, &item});
    }
  } else {
    report.expect(parameters, Kind::table, "a table such as { Kp = [0.0, 10.0] }");
    return result;
  }
  if (given.empty()) report.error(parameters, message::empty_values());
  for (const NamedValue& one : given) {
    auto sought = SoughtReader(draft, one, model).read();
    if (!sought) continue;
    if (std::ranges::find(result, one.name, &Sought::name) != result.end()) {
      report.error(one.at, message::set_twice(one.name));
    } else if (!open && !(sought->lower > -infinity && sought->upper < infinity)) {
      report.error(one.at, message::bounds_needed(one.name));
    } else {
      result.push_back(*std::move(sought));
    }
  }
  return result;
}

std::vector<int> read_models_of(const StudyDraft& draft, const TomlValue& table) {
  if (const TomlValue* model = table.find("model")) {
    const int number = read_name(*model, "model", names_of(draft.study.models), draft.report());
    return number < 0 ? std::vector<int>{} : std::vector<int>{number};
  }
  std::vector<int> all(draft.study.models.size());
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = static_cast<int>(k);
  return all;
}

}  // namespace flyball
