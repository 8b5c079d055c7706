#include <algorithm>
#include <cmath>

#include "models/language/messages.h"
#include "studies/language/sampling.h"
#include "studies/language/sections.h"
#include "studies/language/study_messages.h"

namespace flyball {
namespace {

using Kind = TomlValue::Kind;
using Shape = Distribution::Kind;

const std::vector<std::string>& distributions() {
  static const std::vector<std::string> names{"uniform", "normal", "lognormal", "triangular", "choice"};
  return names;
}

/// What the list behind the name of a distribution holds.
constexpr std::string_view arguments[] = {"[lower, upper]", "[mean, standard deviation]",
                                          "[median, factor of one standard deviation]",
                                          "[lower, most likely, upper]", "one value or more"};

class DistributionReader {
 public:
  DistributionReader(const StudyDraft& draft, const NamedValue& given)
      : settings_(draft.settings), report_(draft.report()), given_(given) {}

  std::optional<Distribution> read() {
    const TomlValue& table = *given_.value;
    if (!settings_.expect_number_place(given_)) return std::nullopt;
    if (!report_.expect(table, Kind::table, "a distribution such as { normal = [1.0, 0.1] }"))
      return std::nullopt;
    auto known = distributions();
    known.emplace_back("within");
    const int before = report_.errors();
    report_.check_keys(table, "a distribution", known);
    if (report_.errors() > before) return std::nullopt;
    const TomlEntry* chosen = choose(table);
    if (chosen == nullptr || !read_shape(*chosen)) return std::nullopt;
    if (const TomlValue* within = table.find("within"); within != nullptr && !read_within(*within))
      return std::nullopt;
    return result_;
  }

 private:
  const TomlEntry* choose(const TomlValue& table) const {
    const TomlEntry* chosen = nullptr;
    int count = 0;
    for (const TomlEntry& entry : table.entries) {
      if (entry.key == "within") continue;
      chosen = &entry;
      ++count;
    }
    if (count == 1) return chosen;
    report_.error(given_.at, message::one_distribution(distributions()));
    return nullptr;
  }

  bool read_shape(const TomlEntry& entry) {
    const auto kind = std::ranges::find(distributions(), entry.key) - distributions().begin();
    const TomlValue& list = entry.value;
    result_.kind = static_cast<Shape>(kind);
    if (!report_.expect(list, Kind::list, arguments[kind])) return false;
    const std::size_t wanted = result_.kind == Shape::triangular ? 3 : 2;
    const bool fits = result_.kind == Shape::choice ? !list.items.empty() : list.items.size() == wanted;
    if (!fits) {
      report_.error(list, message::argument_list(entry.key, arguments[kind], list.items.size()));
      return false;
    }
    switch (result_.kind) {
      case Shape::uniform:
        return take(list.items[0], true, result_.a) && take(list.items[1], true, result_.b) &&
               expect_order(list.items[0], "lower end", result_.a, "upper end", result_.b);
      case Shape::normal:
        return take(list.items[0], true, result_.a) && take_deviation(list.items[1]);
      case Shape::lognormal:
        return take(list.items[0], true, result_.a) &&
               expect_above(list.items[0], "a median above 0", result_.a, 0.0) && take_factor(list.items[1]);
      case Shape::triangular:
        return read_triangle(list);
      case Shape::choice:
        return read_choice(list);
    }
    return false;
  }

  bool read_triangle(const TomlValue& list) {
    for (double* end : {&result_.a, &result_.c, &result_.b}) {
      const auto k = static_cast<std::size_t>(end == &result_.a ? 0 : end == &result_.c ? 1 : 2);
      if (!take(list.items[k], true, *end)) return false;
    }
    return expect_order(list.items[0], "lower end", result_.a, "upper end", result_.b) &&
           expect_within(list.items[1]);
  }

  bool read_choice(const TomlValue& list) {
    bool good = true;
    for (const TomlValue& item : list.items) {
      double value = 0.0;
      good = take(item, true, value) && good;
      result_.values.push_back(value);
    }
    return good;
  }

  bool read_within(const TomlValue& within) {
    if (!report_.expect(within, Kind::list, "[lower, upper]")) return false;
    if (within.items.size() != 2) {
      report_.error(within, message::argument_list("within", "[lower, upper]", within.items.size()));
      return false;
    }
    if (result_.kind != Shape::normal && result_.kind != Shape::lognormal) {
      report_.error(within, message::no_truncation(distributions()[static_cast<int>(result_.kind)]));
      return false;
    }
    double lower = 0.0, upper = 0.0;
    if (!take(within.items[0], true, lower) || !take(within.items[1], true, upper)) return false;
    if (!expect_order(within.items[0], "lower end", lower, "upper end", upper)) return false;
    result_.lowest = lower;
    result_.highest = upper;
    // The quantiles of an empty part are not above each other.
    if (result_.quantile(0.75) > result_.quantile(0.25)) return true;
    report_.error(within, message::nothing_within(lower, upper));
    return false;
  }

  bool take(const TomlValue& value, bool in_range, double& number) const {
    const auto found = settings_.number(given_.name, value, in_range);
    if (found) number = *found;
    return found.has_value();
  }

  bool take_deviation(const TomlValue& value) {
    if (value.is(Kind::string) && value.text.find("degC") != std::string::npos) {
      report_.error(value, message::difference_in_kelvin());
      return false;
    }
    return take(value, false, result_.b) && expect_above(value, "a deviation above 0", result_.b, 0.0);
  }

  bool take_factor(const TomlValue& value) {
    const auto factor = settings_.quantity(value, "1");
    if (!factor) return false;
    result_.b = *factor;
    return expect_above(value, "a factor above 1", *factor, 1.0);
  }

  bool expect_above(const TomlValue& value, std::string_view what, double number, double least) const {
    if (number > least) return true;
    report_.error(value, message::spread_not_positive(what, number));
    return false;
  }

  bool expect_order(const TomlValue& at, std::string_view low, double a, std::string_view high,
                    double b) const {
    if (a < b) return true;
    report_.error(at, message::not_in_order(low, a, high, b));
    return false;
  }

  bool expect_within(const TomlValue& mode) const {
    if (result_.a <= result_.c && result_.c <= result_.b) return true;
    report_.error(mode, message::out_of_range("most likely value", result_.c, {result_.a, result_.b}, "any"));
    return false;
  }

  const SettingReader& settings_;
  const Report& report_;
  const NamedValue& given_;
  Distribution result_;
};

}  // namespace

void read_monte_carlo(const StudyDraft& draft) {
  const TomlValue* section = draft.section("monte_carlo");
  if (section == nullptr) return;
  MonteCarlo& result = draft.study.monte_carlo;
  if (section->find("runs") == nullptr) {
    const TomlEntry& at = *std::ranges::find(draft.root.entries, "monte_carlo", &TomlEntry::key);
    draft.report().error(at.at, message::spread_without_runs());
  }
  result.runs = static_cast<int>(read_count(*section, "runs", 1, most_runs, draft.report()));
  const std::vector<std::string> samplings{"random", "latin_hypercube", "sobol"};
  std::string sampling = "random";
  read_word(*section, "sampling", samplings, sampling, draft.report());
  result.sampling =
      static_cast<MonteCarlo::Sampling>(std::ranges::find(samplings, sampling) - samplings.begin());
  for (const NamedValue& given : draft.settings.named(*section, {"runs", "sampling"})) {
    if (auto spread = DistributionReader(draft, given).read())
      result.spread.emplace_back(given.name, *std::move(spread));
  }
  if (result.sampling == MonteCarlo::Sampling::sobol && result.spread.size() > sobol_dimensions) {
    draft.report().error(*section->find("sampling"),
                         message::too_many_for_sobol(result.spread.size(), sobol_dimensions));
  }
}

}  // namespace flyball
