#include "models/diagram_report.h"

#include <algorithm>

#include "models/language/messages.h"
#include "models/language/text_error.h"
#include "models/language/units.h"

namespace flyball {

void Report::note(Position at, std::string message) const {
  if (at.line > 0) diagnostics_.note(here(at), std::move(message));
}

void Report::error(const TomlValue& value, std::string message) const {
  if (value.override_index < 0) return error(value.at, std::move(message));
  diagnostics_.error({}, message::in_override(overrides_[value.override_index].name, message));
}

void Report::error_inside(const TomlValue& string, std::size_t offset, std::string message) const {
  if (string.override_index >= 0) return error(string, std::move(message));
  error(inside(string, offset), std::move(message));
}

Position Report::here(Position at) const {
  if (diagnostics_.file(at.source) == diagnostics_.file(source_)) at.source = source_;
  return at;
}

bool Report::expect(const TomlValue& value, TomlValue::Kind kind, std::string_view expected) const {
  if (value.is(kind)) return true;
  error(value, message::wrong_type(expected, value));
  return false;
}

void Report::check_keys(const TomlValue& table, std::string_view owner,
                        const std::vector<std::string>& known) const {
  for (const TomlEntry& entry : table.entries) {
    if (std::ranges::find(known, entry.key) == known.end()) {
      error(entry.at, message::unknown_key(entry.key, owner, known));
    }
  }
}

std::string Report::text(const TomlValue& table, std::string_view key) const {
  const TomlValue* value = table.find(key);
  if (value == nullptr || !expect(*value, TomlValue::Kind::string, "a text in quotes")) return {};
  return value->text;
}

std::optional<std::string> Report::unit(const TomlValue& value) const {
  if (!expect(value, TomlValue::Kind::string, "a unit in quotes")) return std::nullopt;
  try {
    const Unit unit = parse_unit(value.text);
    if (unit.si()) return value.text;
    error(value, message::unit_not_si(value.text, unit.dimension));
  } catch (const TextError& wrong) {
    error_inside(value, wrong.offset(), wrong.what());
  }
  return std::nullopt;
}

const TomlValue* find_table(const TomlValue& table, std::string_view key) {
  const TomlValue* found = table.find(key);
  return found != nullptr && found->is(TomlValue::Kind::table) ? found : nullptr;
}

}  // namespace flyball
