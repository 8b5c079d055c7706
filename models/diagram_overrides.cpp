#include "models/diagram_overrides.h"

#include <algorithm>
#include <charconv>

#include "models/language/messages.h"

namespace flyball {
namespace {

using Kind = TomlValue::Kind;

TomlEntry* find_entry(TomlValue* table, std::string_view key) {
  if (table == nullptr) return nullptr;
  const auto found = std::ranges::find(table->entries, key, &TomlEntry::key);
  return found == table->entries.end() ? nullptr : &*found;
}

TomlValue* find_table(TomlValue* table, std::string_view key) {
  TomlEntry* entry = find_entry(table, key);
  return entry != nullptr && entry->value.is(Kind::table) ? &entry->value : nullptr;
}

std::vector<std::string> keys(const TomlValue* table) {
  std::vector<std::string> names;
  if (table == nullptr) return names;
  for (const TomlEntry& entry : table->entries) names.push_back(entry.key);
  return names;
}

/// A whole number or a truth value stays one, since structure may ask for it; all else is an expression or a
/// text.
TomlValue value_of(const std::string& text, int index) {
  TomlValue value;
  value.override_index = index;
  value.kind = Kind::string;
  value.text = text;
  const char* end = text.data() + text.size();
  if (text == "true" || text == "false") {
    value.kind = Kind::boolean;
    value.flag = text == "true";
  } else if (std::from_chars(text.data(), end, value.integer).ptr == end && !text.empty()) {
    value.kind = Kind::integer;
    value.number = static_cast<double>(value.integer);
  }
  return value;
}

/// What an override replaces stays known: it says which dimension is wanted.
void replace(TomlValue& old, TomlValue value) {
  value.replaced = old.replaced ? old.replaced : std::make_shared<const TomlValue>(std::move(old));
  old = std::move(value);
}

void set(TomlValue& table, std::string_view key, TomlValue value) {
  if (TomlEntry* entry = find_entry(&table, key)) {
    replace(entry->value, std::move(value));
  } else {
    table.entries.push_back({std::string(key), {}, std::move(value)});
  }
}

/// "numerator[1]" is an entry of a list, "A[0][1]" of a list of lists. False when the file has no such entry.
bool set_indexed(TomlValue& block, std::string_view name, TomlValue value) {
  const std::size_t bracket = name.find('[');
  TomlEntry* entry = find_entry(&block, name.substr(0, bracket));
  TomlValue* target = entry == nullptr ? nullptr : &entry->value;
  for (std::string_view rest = name.substr(bracket); !rest.empty() && target != nullptr;) {
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(rest.data() + 1, rest.data() + rest.size(), index);
    const bool closed =
        rest[0] == '[' && error == std::errc() && end != rest.data() + rest.size() && *end == ']';
    if (!closed || !target->is(Kind::list) || index >= target->items.size()) return false;
    target = &target->items[index];
    rest.remove_prefix(static_cast<std::size_t>(end - rest.data()) + 1);
  }
  if (target != nullptr) replace(*target, std::move(value));
  return target != nullptr;
}

void apply_to_parameter(const Override& given, TomlValue value, TomlValue* parameters,
                        Diagnostics& diagnostics) {
  TomlEntry* entry = find_entry(parameters, given.name);
  if (entry == nullptr) {
    const std::string unknown = message::unknown_parameter(given.name, keys(parameters));
    diagnostics.error({}, message::in_override(given.name, unknown));
  } else if (entry->value.is(Kind::table)) {
    set(entry->value, "value", std::move(value));
  } else {
    replace(entry->value, std::move(value));
  }
}

}  // namespace

void apply_to_parameters(const std::vector<Override>& overrides, TomlValue& root, Diagnostics& diagnostics) {
  for (std::size_t k = 0; k < overrides.size(); ++k) {
    if (overrides[k].name.find('.') != std::string::npos) continue;
    apply_to_parameter(overrides[k], value_of(overrides[k].value, static_cast<int>(k)),
                       find_table(&root, "parameters"), diagnostics);
  }
}

void apply_to_block(const std::vector<Override>& overrides, int number, TomlEntry& block,
                    Diagnostics& diagnostics) {
  const Override& given = overrides[number];
  const std::string setting = given.name.substr(given.name.rfind('.') + 1);
  TomlValue value = value_of(given.value, number);
  if (setting.find('[') == std::string::npos) {
    set(block.value, setting, std::move(value));
  } else if (!set_indexed(block.value, setting, std::move(value))) {
    diagnostics.error({}, message::in_override(given.name, message::no_such_entry(block.key, setting)));
  }
}

}  // namespace flyball
