#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "blocks/rational.h"
#include "models/language/messages.h"
#include "studies/language/sections.h"
#include "studies/language/study_messages.h"

namespace flyball {
namespace {

using Kind = TomlValue::Kind;

constexpr int most_points = 1'000'000;

/// { from, to, points | step, scale }
struct AxisRange {
  double from = 0.0, to = 0.0;
  std::int64_t points = 1;
  bool logarithmic = false;

  double value(std::int64_t k) const {
    if (k == 0) return from;
    if (k == points - 1) return to;
    const double part = static_cast<double>(k) / static_cast<double>(points - 1);
    return logarithmic ? from * std::pow(to / from, part) : from + (to - from) * part;
  }
};

class AxisReader {
 public:
  AxisReader(const StudyDraft& draft, const NamedValue& given)
      : settings_(draft.settings), report_(draft.report()), given_(given) {}

  Axis read() {
    Axis axis;
    axis.name = given_.name;
    if (given_.value->is(Kind::list)) {
      read_list(axis);
    } else if (given_.value->is(Kind::table)) {
      read_range(axis);
    } else {
      report_.error(
          *given_.value,
          message::wrong_type("a list of values, or a range such as { from = 0.0, to = 1.0, points = 11 }",
                              *given_.value));
    }
    return axis;
  }

 private:
  void read_list(Axis& axis) {
    if (given_.value->items.empty()) return report_.error(*given_.value, message::empty_values());
    std::vector<Position> places;
    for (const TomlValue& item : given_.value->items) {
      auto setting = settings_.read({given_.name, item.at, &item});
      if (!setting) continue;
      axis.values.push_back(std::move(setting->value));
      places.push_back(item.at);
    }
    if (axis.values.size() == given_.value->items.size()) try_values(axis, places);
  }

  /// Numbers of a slot differ in range at most, which `read` has checked: the first stands for them all.
  void try_values(const Axis& axis, const std::vector<Position>& places) {
    if (!settings_.knows(axis.name))
      return settings_.try_on_models({{axis.name, axis.values[0]}}, {given_.at});
    bool tried = false;
    for (std::size_t k = 0; k < axis.values.size(); ++k) {
      const bool number = std::holds_alternative<double>(axis.values[k]);
      if (number && tried) continue;
      tried = tried || number;
      settings_.try_on_models({{axis.name, axis.values[k]}}, {places[k]});
    }
  }

  void read_range(Axis& axis) {
    const TomlValue& table = *given_.value;
    report_.check_keys(table, "a range", {"from", "to", "points", "step", "scale"});
    const auto from = end(table, "from", axis), to = end(table, "to", axis);
    AxisRange range;
    std::string scale = "linear";
    read_word(table, "scale", {"linear", "log"}, scale, report_);
    range.logarithmic = scale == "log";
    if (!from || !to) return;
    range.from = *from;
    range.to = *to;
    const TomlValue* points = table.find("points");
    const TomlValue* step = table.find("step");
    if ((points == nullptr) == (step == nullptr)) return report_.error(given_.at, message::points_or_step());
    const bool one_side = range.from * range.to > 0.0;
    if (range.logarithmic && !one_side)
      return report_.error(given_.at, message::log_needs_one_side(range.from, range.to));
    if (points != nullptr) {
      range.points = read_count(table, "points", 0, most_points, report_);
    } else {
      range.points = read_step(*step, range);
    }
    fill(axis, range);
  }

  std::optional<double> end(const TomlValue& table, const char* key, const Axis& axis) {
    const TomlValue* value = table.find(key);
    if (value == nullptr) {
      report_.error(given_.at, message::missing_key(key, axis.name));
      return std::nullopt;
    }
    const auto setting = settings_.read({given_.name, value->at, value});
    if (!setting) return std::nullopt;
    settings_.try_on_models({*setting}, {settings_.knows(axis.name) ? value->at : given_.at});
    if (const auto* number = std::get_if<double>(&setting->value)) return *number;
    as_text_ = true;
    return settings_.quantity(*value, "any");
  }

  /// How many points a step gives; `to` becomes the last of them. 0 when the step is wrong.
  std::int64_t read_step(const TomlValue& value, AxisRange& range) {
    if (range.logarithmic) return report_.error(value, message::log_without_step()), 0;
    const auto step =
        as_text_ ? settings_.quantity(value, "any") : settings_.number(given_.name, value, false);
    if (!step) return 0;
    // A step that divides the range but for rounding reaches its end.
    const double steps = (range.to - range.from) / *step + 1e-9;
    if (!(steps >= 0.0)) return report_.error(value, message::step_away(range.from, range.to)), 0;
    if (steps >= most_points) return report_.error(value, message::point_count(steps, most_points)), 0;
    const auto whole = static_cast<std::int64_t>(steps);
    range.to = range.from + static_cast<double>(whole) * *step;
    return whole + 1;
  }

  void fill(Axis& axis, const AxisRange& range) {
    for (std::int64_t k = 0; k < range.points; ++k) {
      const double value = range.value(k);
      if (as_text_) {
        axis.values.emplace_back(exact_text(value));
      } else {
        axis.values.emplace_back(value);
      }
    }
  }

  /// Structure wants the fraction that is meant: 0.3, not 0.30000000000000004.
  static std::string exact_text(double value) {
    const auto exact = nearest_fraction(value);
    return exact ? fmt::format("{}/{}", exact->numerator(), exact->denominator()) : fmt::format("{}", value);
  }

  const SettingReader& settings_;
  const Report& report_;
  const NamedValue& given_;
  bool as_text_ = false;  // it sets no slot
};

void check_zip(const StudyDraft& draft, const std::vector<NamedValue>& given) {
  const std::vector<Axis>& axes = draft.study.sweep.axes;
  for (std::size_t k = 1; k < axes.size(); ++k) {
    const std::size_t first = axes[0].values.size(), other = axes[k].values.size();
    if (first == 0 || other == 0 || first == other) continue;
    draft.report().error(given[k].at, message::unequal_axes(axes[0].name, first, axes[k].name, other));
  }
}

}  // namespace

void read_sweep(const StudyDraft& draft) {
  const TomlValue* section = draft.section("sweep");
  if (section == nullptr) return;
  std::string combine = "product";
  read_word(*section, "combine", {"product", "zip"}, combine, draft.report());
  draft.study.sweep.zipped = combine == "zip";
  const auto given = draft.settings.named(*section, {"combine"});
  for (const NamedValue& axis : given) draft.study.sweep.axes.push_back(AxisReader(draft, axis).read());
  if (draft.study.sweep.zipped) check_zip(draft, given);
}

std::int64_t SweepGrid::points() const {
  if (axes.empty()) return 1;
  if (zipped) return static_cast<std::int64_t>(axes[0].values.size());
  std::int64_t product = 1;
  for (const Axis& axis : axes) {
    const auto count = static_cast<std::int64_t>(axis.values.size());
    // A reader refuses more than `most_runs`, so what is beyond it need not be told apart.
    if (count > 0 && product > std::numeric_limits<std::int64_t>::max() / count)
      return std::numeric_limits<std::int64_t>::max();
    product *= count;
  }
  return product;
}

}  // namespace flyball
