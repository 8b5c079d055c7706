#include <algorithm>

#include "models/language/messages.h"
#include "models/language/names.h"
#include "studies/language/sought.h"
#include "studies/language/study_messages.h"

namespace flyball {
namespace {

using Kind = TomlValue::Kind;

class FrontReader {
 public:
  FrontReader(const StudyDraft& draft, const TomlEntry& entry)
      : draft_(draft), report_(draft.report()), entry_(entry), table_(entry.value) {
    front_.name = entry.key;
    front_.at = entry.at;
  }

  ParetoDefinition read(int model) {
    front_.model = model;
    if (const TomlValue* parameters = table_.find("parameters")) {
      front_.parameters = read_sought(draft_, *parameters, model, false);
    } else {
      report_.error(entry_.at, message::missing_key("parameters", "pareto " + entry_.key));
    }
    read_word(table_, "algorithm", {"nsga2", "moead", "nspso", "mopso"}, front_.algorithm, report_);
    front_.evaluations = read_count(table_, "evaluations", front_.evaluations, most_runs, report_);
    front_.population =
        static_cast<int>(read_count(table_, "population", front_.population, 1'000'000, report_));
    read_objectives();
    read_requirements();
    if (const TomlValue* reference = table_.find("reference"))
      front_.reference = read_by_objective(*reference, "objective");
    if (const TomlValue* pick = table_.find("pick")) read_pick(*pick);
    return front_;
  }

 private:
  void read_objectives() {
    const auto known = names_of(draft_.study.metrics);
    if (const TomlValue* names = table_.find("minimise"))
      front_.minimise = read_names(*names, "metric", known, report_);
    if (const TomlValue* names = table_.find("maximise")) {
      front_.maximise = read_names(*names, "metric", known, report_);
      for (const TomlValue& item : names->items) {
        const auto both =
            std::ranges::find_if(front_.minimise, [&](int metric) { return known[metric] == item.text; });
        if (both != front_.minimise.end()) report_.error(item, message::stands_twice(item.text));
      }
    }
    for (const auto* numbers : {&front_.minimise, &front_.maximise}) {
      for (const int metric : *numbers) objectives_.push_back(known[metric]);
    }
    if (!lists_something(table_, {"minimise", "maximise"}))
      report_.error(entry_.at, message::nothing_to_optimise());
  }

  void read_requirements() {
    if (const TomlValue* names = table_.find("requirements"))
      front_.requirements = read_names(*names, "requirement", names_of(draft_.study.requirements), report_);
    if (const TomlValue* names = table_.find("scenarios"))
      front_.scenarios = read_names(*names, "scenario", names_of(draft_.study.scenarios), report_);
  }

  /// A number for each objective: { overshoot = 0.2, effort = "3 J" }.
  std::vector<double> read_by_objective(const TomlValue& table, std::string_view of) {
    std::vector<double> numbers(objectives_.size(), 0.0);
    if (!report_.expect(table, Kind::table, "a table with a number for each objective")) return {};
    for (const TomlEntry& entry : table.entries) {
      const auto found = std::ranges::find(objectives_, entry.key);
      if (found == objectives_.end()) {
        report_.error(entry.at, message::no_such_thing("objective", entry.key, objectives_));
      } else if (const auto number = draft_.settings.quantity(entry.value, "any")) {
        numbers[static_cast<std::size_t>(found - objectives_.begin())] = *number;
      }
    }
    if (table.entries.size() != objectives_.size())
      report_.error(table, message::number_count(of, objectives_.size(), table.entries.size()));
    return numbers;
  }

  void read_pick(const TomlValue& pick) {
    if (pick.is(Kind::table)) {
      front_.pick = "weights";
      front_.weights = read_by_objective(pick, "objective");
      return;
    }
    auto known = objectives_;
    known.insert(known.begin(), "knee");
    read_word(table_, "pick", known, front_.pick, report_);
  }

  const StudyDraft& draft_;
  const Report& report_;
  const TomlEntry& entry_;
  const TomlValue& table_;
  std::vector<std::string> objectives_;
  ParetoDefinition front_;
};

}  // namespace

void read_fronts(const StudyDraft& draft) {
  const TomlValue* section = draft.section("pareto");
  if (section == nullptr) return;
  for (const TomlEntry& entry : section->entries) {
    if (!draft.report().expect(entry.value, Kind::table, "a section such as [pareto.gains]")) continue;
    if (!is_name(entry.key)) draft.report().error(entry.at, message::not_a_name(entry.key));
    draft.report().check_keys(entry.value, "pareto " + entry.key,
                              {"model", "algorithm", "evaluations", "population", "parameters", "minimise",
                               "maximise", "requirements", "scenarios", "reference", "pick"});
    for (const int model : read_models_of(draft, entry.value))
      draft.study.fronts.push_back(FrontReader(draft, entry).read(model));
  }
}

}  // namespace flyball
