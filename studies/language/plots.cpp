#include <algorithm>

#include "models/language/messages.h"
#include "studies/language/sections.h"
#include "studies/language/study_messages.h"

namespace flyball {
namespace {

using Kind = TomlValue::Kind;

/// Logged signals that some model has.
std::vector<std::string> all_signals(const Study& study) {
  std::vector<std::string> names;
  for (const StudyModel& model : study.models) {
    for (const LogColumn& column : model.plan->columns) {
      if (std::ranges::find(names, column.name) == names.end()) names.push_back(column.name);
    }
  }
  return names;
}

PlotDefinition read_plot(const StudyDraft& draft, const TomlValue& table) {
  const Report& report = draft.report();
  report.check_keys(table, "a plot", {"title", "signals", "x", "by", "scenario"});
  PlotDefinition plot;
  plot.title = report.text(table, "title");
  auto known = all_signals(draft.study);
  if (const TomlValue* x = table.find("x")) {
    for (const auto& [name, text] : draft.study.metrics) known.push_back(name);
    auto along = known;
    for (const Axis& axis : draft.study.sweep.axes) along.push_back(axis.name);
    if (read_name(*x, "signal, metric or axis of [sweep]", along, report) >= 0) plot.x = x->text;
  }
  const TomlValue* signals = table.find("signals");
  if (signals == nullptr) {
    report.error(table, message::missing_key("signals", "a plot"));
  } else {
    const auto kind = table.find("x") == nullptr ? "logged signal" : "signal or metric";
    for (const int number : read_names(*signals, kind, known, report)) plot.signals.push_back(known[number]);
    if (signals->is(Kind::list) && signals->items.empty()) report.error(*signals, message::empty_values());
  }
  read_word(table, "by", {"case", "scenario", "sweep", "model"}, plot.by, report);
  if (const TomlValue* scenario = table.find("scenario")) {
    if (read_name(*scenario, "scenario", names_of(draft.study.scenarios), report) >= 0)
      plot.scenario = scenario->text;
  }
  return plot;
}

}  // namespace

void read_plots(const StudyDraft& draft) {
  const TomlValue* plots = draft.root.find("plot");
  if (plots == nullptr || !draft.report().expect(*plots, Kind::list, "sections [[plot]]")) return;
  for (const TomlValue& plot : plots->items) {
    if (draft.report().expect(plot, Kind::table, "a section [[plot]]"))
      draft.study.plots.push_back(read_plot(draft, plot));
  }
}

}  // namespace flyball
