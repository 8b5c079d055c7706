#include "models/language/messages.h"
#include "studies/language/sections.h"

namespace flyball {
namespace {

using Kind = TomlValue::Kind;

std::vector<std::pair<std::string, std::string>> read_texts(const StudyDraft& draft, std::string_view name,
                                                            std::string_view example) {
  std::vector<std::pair<std::string, std::string>> texts;
  const TomlValue* section = draft.section(name);
  if (section == nullptr) return texts;
  for (const TomlEntry& entry : section->entries) {
    if (expect_label(entry, draft.report()) && draft.report().expect(entry.value, Kind::string, example))
      texts.emplace_back(entry.key, entry.value.text);
  }
  return texts;
}

}  // namespace

void read_criteria(const StudyDraft& draft) {
  draft.study.metrics = read_texts(draft, "metrics", "a metric in quotes, such as \"overshoot(y)\"");
  draft.study.requirements =
      read_texts(draft, "requirements", "a requirement in quotes, such as \"overshoot(y) < 5 %\"");
}

}  // namespace flyball
