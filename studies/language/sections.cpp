#include "studies/language/sections.h"

#include <algorithm>

#include "models/language/messages.h"
#include "studies/language/study_messages.h"

namespace flyball {

using Kind = TomlValue::Kind;

const TomlValue* StudyDraft::section(std::string_view name) const {
  const TomlValue* found = root.find(name);
  return found != nullptr && report().expect(*found, Kind::table, "a section") ? found : nullptr;
}

std::vector<int> read_names(const TomlValue& list, std::string_view kind,
                            const std::vector<std::string>& known, const Report& report) {
  std::vector<int> numbers;
  if (!report.expect(list, Kind::list, "a list of names in quotes")) return numbers;
  for (const TomlValue& item : list.items) {
    const int number = read_name(item, kind, known, report);
    if (number < 0) continue;
    if (std::ranges::find(numbers, number) != numbers.end()) {
      report.error(item, message::stands_twice(item.text));
    } else {
      numbers.push_back(number);
    }
  }
  return numbers;
}

int read_name(const TomlValue& text, std::string_view kind, const std::vector<std::string>& known,
              const Report& report) {
  if (!report.expect(text, Kind::string, "a name in quotes")) return -1;
  const auto found = std::ranges::find(known, text.text);
  if (found != known.end()) return static_cast<int>(found - known.begin());
  report.error_inside(text, 0, message::no_such_thing(kind, text.text, known));
  return -1;
}

void read_word(const TomlValue& table, std::string_view key, const std::vector<std::string>& words,
               std::string& result, const Report& report) {
  const TomlValue* value = table.find(key);
  if (value == nullptr || !report.expect(*value, Kind::string, "a word in quotes")) return;
  result = value->text;
  if (std::ranges::find(words, result) == words.end())
    report.error_inside(*value, 0, message::unknown_choice(key, result, words));
}

std::int64_t read_count(const TomlValue& table, std::string_view key, std::int64_t fallback,
                        std::int64_t most, const Report& report) {
  const TomlValue* value = table.find(key);
  if (value == nullptr || !report.expect(*value, Kind::integer, "a whole number")) return fallback;
  const Range range{1.0, static_cast<double>(most)};
  if (range.contains(value->number)) return value->integer;
  report.error(*value, message::out_of_range(key, value->number, range, "1"));
  return fallback;
}

bool lists_something(const TomlValue& table, std::initializer_list<std::string_view> keys) {
  return std::ranges::any_of(keys, [&](std::string_view key) {
    const TomlValue* list = table.find(key);
    return list != nullptr && !(list->is(Kind::list) && list->items.empty());
  });
}

bool expect_label(const TomlEntry& entry, const Report& report) {
  const bool printable =
      std::ranges::none_of(entry.key, [](unsigned char c) { return c < 0x20 || c == 0x7F; });
  if (printable && !entry.key.empty()) return true;
  report.error(entry.at, message::not_a_label(entry.key));
  return false;
}

std::vector<std::string> names_of(const std::vector<std::pair<std::string, std::string>>& all) {
  std::vector<std::string> names;
  for (const auto& [name, text] : all) names.push_back(name);
  return names;
}

}  // namespace flyball
