#include <algorithm>

#include "models/language/messages.h"
#include "studies/language/sections.h"
#include "studies/language/study_messages.h"
#include "studies/language/study_models.h"

namespace flyball {
namespace {

using Kind = TomlValue::Kind;

constexpr int format_version = 1;

void check_version(const TomlValue& root, const Report& report) {
  const TomlValue* version = root.find("flyball");
  if (version == nullptr) return report.error(Position{1, 1}, message::missing_version(format_version));
  if (!report.expect(*version, Kind::integer, "the version of the file format")) return;
  if (version->integer != format_version)
    report.error(*version, message::unknown_version(version->integer, format_version));
}

/// [study] itself.
void read_head(const TomlValue& root, const Report& report, Diagnostics& diagnostics, Study& study) {
  const TomlValue* section = root.find("study");
  if (section == nullptr) return report.error(Position{1, 1}, message::missing_section("study"));
  if (!report.expect(*section, Kind::table, "a section")) return;
  report.check_keys(*section, "[study]", {"title", "model", "models", "seed"});
  study.title = report.text(*section, "title");
  const TomlValue* seed = section->find("seed");
  if (seed != nullptr && report.expect(*seed, Kind::integer, "a whole number")) {
    if (seed->integer < 0)
      report.error(*seed, message::out_of_range("seed", seed->number, non_negative, "1"));
    study.seed = static_cast<std::uint64_t>(seed->integer);
  }
  study.models = read_study_models(*section, report, diagnostics);
}

}  // namespace

void check_size(const StudyDraft& draft) {
  const Study& study = draft.study;
  std::int64_t runs = 1;
  const auto times = [&](std::int64_t count) {
    runs = count > 0 && runs > most_runs / count ? most_runs + 1 : runs * count;
  };
  times(static_cast<std::int64_t>(study.models.size()));
  times(static_cast<std::int64_t>(study.cases.size()));
  times(static_cast<std::int64_t>(study.scenarios.size()));
  times(study.sweep.points());
  times(study.monte_carlo.runs);
  if (runs <= most_runs) return;
  const bool swept = draft.root.find("sweep") != nullptr;
  draft.report().error(*draft.root.find(swept ? "sweep" : "monte_carlo"), message::too_many_runs(most_runs));
}

bool is_study(std::string_view text) {
  Diagnostics unheard("");
  const auto document = parse_toml(text, unheard);
  return document && document->root().find("study") != nullptr;
}

std::optional<Study> read_study(std::string_view text, Diagnostics& diagnostics) {
  const auto document = parse_toml(text, diagnostics);
  if (!document) return std::nullopt;
  const std::vector<Override> no_overrides;
  const Report report(*document, no_overrides, diagnostics, 0);
  const TomlValue& root = document->root();
  report.check_keys(root, "a study file",
                    {"flyball", "study", "cases", "scenarios", "sweep", "monte_carlo", "metrics",
                     "requirements", "fit", "pareto", "bisect", "plot"});
  check_version(root, report);
  Study study;
  study.file = diagnostics.file();
  study.text = text;
  read_head(root, report, diagnostics, study);
  const SettingReader settings(report, diagnostics, study.models);
  const StudyDraft draft{root, settings, study};
  read_criteria(draft);
  read_scenarios(draft);
  read_sweep(draft);
  read_monte_carlo(draft);
  read_fits(draft);
  read_fronts(draft);
  read_bisections(draft);
  read_cases(draft);
  read_plots(draft);
  check_size(draft);
  return diagnostics.failed() ? std::nullopt : std::optional(std::move(study));
}

}  // namespace flyball
