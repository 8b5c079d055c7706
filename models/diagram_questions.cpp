#include "models/diagram_questions.h"

#include "models/language/expression.h"
#include "models/language/messages.h"
#include "models/language/names.h"

namespace flyball {

std::vector<Question> read_questions(const TomlValue* section, const Report& report) {
  std::vector<Question> questions;
  if (section == nullptr) return questions;
  for (const auto& [name, at, value] : section->entries) {
    if (!is_name(name) || is_reserved(name)) report.error(at, message::not_a_name(name));
    if (!report.expect(value, TomlValue::Kind::string, "a text in quotes such as \"max(y) < 5 V\"")) continue;
    Question question{name, value.text, {}};
    for (std::size_t k = 0; k <= value.text.size(); ++k)
      question.at.push_back(report.here(report.inside(value, k)));
    questions.push_back(std::move(question));
  }
  return questions;
}

}  // namespace flyball
