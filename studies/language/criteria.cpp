#include <filesystem>

#include "models/language/messages.h"
#include "models/language/text_error.h"
#include "studies/language/sections.h"
#include "studies/language/study_messages.h"

namespace flyball {
namespace {

using Kind = TomlValue::Kind;

/// Reads the texts of a section, and each of them on every model with `make(text, model)`.
template <class Make>
std::vector<std::pair<std::string, std::string>> read_texts(const StudyDraft& draft, std::string_view name,
                                                            std::string_view example, Make make) {
  std::vector<std::pair<std::string, std::string>> texts;
  const TomlValue* section = draft.section(name);
  if (section == nullptr) return texts;
  for (const TomlEntry& entry : section->entries) {
    if (!expect_label(entry, draft.report())) continue;
    if (!draft.report().expect(entry.value, Kind::string, example)) continue;
    texts.emplace_back(entry.key, entry.value.text);
    for (StudyModel& model : draft.study.models) {
      try {
        make(entry.value.text, model);
      } catch (const TextError& error) {
        const bool several = draft.study.models.size() > 1;
        draft.report().error_inside(entry.value, error.offset(),
                                    several ? message::in_model(error.what(), model.name) : error.what());
        break;
      }
    }
  }
  return texts;
}

}  // namespace

void read_criteria(const StudyDraft& draft) {
  const auto folder = std::filesystem::path(draft.report().file()).parent_path();
  const auto add_metric = [&](const std::string& text, StudyModel& model) {
    model.metrics.emplace_back(text, model.plan->columns, folder);
  };
  const auto add_requirement = [&](const std::string& text, StudyModel& model) {
    model.requirements.emplace_back(text, model.plan->columns, folder);
  };
  draft.study.metrics =
      read_texts(draft, "metrics", "a metric in quotes, such as \"overshoot(y)\"", add_metric);
  draft.study.requirements = read_texts(
      draft, "requirements", "a requirement in quotes, such as \"overshoot(y) < 5 %\"", add_requirement);
}

}  // namespace flyball
