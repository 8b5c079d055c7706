#include <algorithm>

#include "models/language/messages.h"
#include "studies/language/sections.h"
#include "studies/language/study_messages.h"

namespace flyball {
namespace {

using Kind = TomlValue::Kind;

/// "fit.NAME" and "pareto.NAME", for each that the study has.
std::vector<std::string> answers(const Study& study) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  };
  for (const FitDefinition& fit : study.fits) add("fit." + fit.name);
  for (const ParetoDefinition& front : study.fronts) add("pareto." + front.name);
  return names;
}

/// What chooses a point of a front: "knee", or one of its objectives.
std::vector<std::string> picks(const Study& study, const std::string& from) {
  std::vector<std::string> names{"knee"};
  for (const ParetoDefinition& front : study.fronts) {
    if ("pareto." + front.name != from) continue;
    for (const int metric : front.minimise) names.push_back(study.metrics[metric].first);
    for (const int metric : front.maximise) names.push_back(study.metrics[metric].first);
  }
  return names;
}

void read_from(const StudyDraft& draft, const TomlValue& table, Choice& choice) {
  const TomlValue* from = table.find("from");
  const TomlValue* pick = table.find("pick");
  if (from != nullptr && draft.report().expect(*from, Kind::string, "\"fit.NAME\" or \"pareto.NAME\"")) {
    const auto known = answers(draft.study);
    if (std::ranges::find(known, from->text) != known.end()) {
      choice.from = from->text;
    } else {
      draft.report().error_inside(*from, 0, message::unknown_source(from->text, known));
    }
  }
  if (pick == nullptr) return;
  if (from == nullptr || from->text.starts_with("fit."))
    return draft.report().error(*pick, message::pick_without_front());
  if (!choice.from.empty())
    read_word(table, "pick", picks(draft.study, choice.from), choice.pick, draft.report());
}

std::vector<Choice> read_choices(const StudyDraft& draft, std::string_view name, std::string_view example) {
  std::vector<Choice> choices;
  const TomlValue* section = draft.section(name);
  if (section == nullptr) return choices;
  for (const TomlEntry& entry : section->entries) {
    if (!expect_label(entry, draft.report())) continue;
    if (!draft.report().expect(entry.value, Kind::table, example)) continue;
    Choice choice;
    choice.name = entry.key;
    choice.at = entry.at;
    const bool cases = name == "cases";
    if (cases) read_from(draft, entry.value, choice);
    const auto reserved = cases ? std::vector<std::string>{"from", "pick"} : std::vector<std::string>{};
    choice.settings = draft.settings.read_all(draft.settings.named(entry.value, reserved));
    choices.push_back(std::move(choice));
  }
  return choices;
}

}  // namespace

void read_scenarios(const StudyDraft& draft) {
  draft.study.scenarios = read_choices(draft, "scenarios", "a table such as { load = \"2 N*m\" }");
  if (draft.study.scenarios.empty()) draft.study.scenarios = {{"nominal", {}, "", "", {}}};
}

void read_cases(const StudyDraft& draft) {
  draft.study.cases = read_choices(draft, "cases", "a table such as { Kp = 2.0, Ki = 0.5 }");
  if (draft.study.cases.empty()) draft.study.cases = {{"model", {}, "", "", {}}};
}

}  // namespace flyball
