#include "models/diagram_report.h"

#include <algorithm>

#include "models/language/messages.h"

namespace flyball {

void Report::note(Position at, std::string message) {
  if (at.line > 0) diagnostics_.note(at, std::move(message));
}

void Report::error(const TomlValue& value, std::string message) {
  if (value.override_index < 0) return diagnostics_.error(value.at, std::move(message));
  diagnostics_.error({}, message::in_override(overrides_[value.override_index].name, message));
}

void Report::error_inside(const TomlValue& string, std::size_t offset, std::string message) {
  if (string.override_index >= 0) return error(string, std::move(message));
  diagnostics_.error(inside(string, offset), std::move(message));
}

bool Report::expect(const TomlValue& value, TomlValue::Kind kind, std::string_view expected) {
  if (value.is(kind)) return true;
  error(value, message::wrong_type(expected, value));
  return false;
}

void Report::check_keys(const TomlValue& table, std::string_view owner,
                        const std::vector<std::string>& known) {
  for (const TomlEntry& entry : table.entries) {
    if (std::ranges::find(known, entry.key) == known.end()) {
      error(entry.at, message::unknown_key(entry.key, owner, known));
    }
  }
}

std::string Report::text(const TomlValue& table, std::string_view key) {
  const TomlValue* value = table.find(key);
  if (value == nullptr || !expect(*value, TomlValue::Kind::string, "a text in quotes")) return {};
  return value->text;
}

}  // namespace flyball
