#include "models/language/toml.h"

// The parser's own checks report an error right behind what it asserts: "[.a]" must not abort, or worse, be
// assumed away.
#define TOML_EXCEPTIONS 0
#include <toml++/impl/preprocessor.h>
#undef TOML_ASSERT
#undef TOML_ASSERT_ASSUME
#define TOML_ASSERT(expression) static_assert(true)
#define TOML_ASSERT_ASSUME(expression) static_assert(true)
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "models/language/messages.h"

namespace flyball {
namespace {

Position position_of(const toml::source_position& at, const SourceText& source) {
  return {static_cast<int>(at.line), static_cast<int>(at.column), source.number()};
}

/// A key that stood twice was renamed, so that the text could be parsed: its new place and its name.
using Renamed = std::map<Position, std::string>;

class Converter {
 public:
  Converter(const SourceText& source, const Renamed& renamed, Diagnostics& diagnostics)
      : source_(source), renamed_(renamed), diagnostics_(diagnostics) {}

  TomlValue value(const toml::node& node) {
    TomlValue result;
    result.at = position_of(node.source().begin, source_);
    switch (node.type()) {
      case toml::node_type::table:
        table(*node.as_table(), result);
        break;
      case toml::node_type::array:
        list(*node.as_array(), result);
        break;
      case toml::node_type::string:
        result.kind = TomlValue::Kind::string;
        result.text = **node.as_string();
        break;
      case toml::node_type::integer:
        result.kind = TomlValue::Kind::integer;
        result.integer = **node.as_integer();
        result.number = static_cast<double>(result.integer);
        break;
      case toml::node_type::floating_point:
        number(**node.as_floating_point(), result);
        break;
      case toml::node_type::boolean:
        result.kind = TomlValue::Kind::boolean;
        result.flag = **node.as_boolean();
        break;
      default:
        result.kind = TomlValue::Kind::date;
    }
    return result;
  }

 private:
  void number(double x, TomlValue& result) {
    result.kind = TomlValue::Kind::number;
    const std::size_t first = source_.offset(result.at);
    const std::size_t last = source_.text().find_first_not_of("+-.0123456789_eEnaif", first);
    result.text = source_.text().substr(first, last == std::string::npos ? last : last - first);
    std::erase(result.text, '_');
    result.number = x;
    if (!std::isfinite(x)) diagnostics_.error(result.at, message::not_a_finite_literal(result.text));
  }

  void list(const toml::array& array, TomlValue& result) {
    result.kind = TomlValue::Kind::list;
    result.items.reserve(array.size());
    for (const toml::node& item : array) result.items.push_back(value(item));
  }

  void table(const toml::table& table, TomlValue& result) {
    std::vector<std::pair<Position, std::pair<std::string_view, const toml::node*>>> sorted;
    sorted.reserve(table.size());
    for (const auto& [key, node] : table) {
      sorted.push_back({position_of(key.source().begin, source_), {key.str(), &node}});
    }
    std::ranges::sort(sorted, {}, [](const auto& entry) { return entry.first; });
    result.entries.reserve(sorted.size());
    for (const auto& [at, entry] : sorted) {
      if (const auto again = renamed_.find(at); again != renamed_.end()) {
        diagnostics_.error(at, message::stands_twice(again->second));
        if (const auto first = table.find(again->second); first != table.end()) {
          diagnostics_.note(position_of(first->first.source().begin, source_),
                            message::first_stands_here(again->second));
        }
        continue;
      }
      result.entries.push_back({std::string(entry.first), at, value(*entry.second)});
    }
  }

  const SourceText& source_;
  const Renamed& renamed_;
  Diagnostics& diagnostics_;
};

/// Gives the key before `value_at` another name of the same length, in place; false when there is none.
bool rename_key_before(Position value_at, std::string& text, Renamed& renamed) {
  const SourceText source(text, value_at.source);
  const auto before = [&](std::string_view skipped, std::size_t at) {
    return text.find_last_not_of(skipped, at);
  };
  std::size_t last = before(" \t", source.offset(value_at) - 1);
  if (last == std::string::npos || text[last] != '=') return false;
  last = before(" \t", last - 1);
  if (last == std::string::npos) return false;
  const bool quoted = text[last] == '"' || text[last] == '\'';
  std::size_t first = last;
  const auto in_key = [&](char c) {
    return quoted ? c != text[last]
                  : std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
  };
  while (first > 0 && in_key(text[first - 1])) --first;
  if (quoted) --last;
  const Position at = source.position(quoted ? first - 1 : first);
  std::string key = text.substr(first, last + 1 - first);
  // Each further duplicate of a short key takes another letter, so that they do not collide with each other.
  constexpr std::string_view letters = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz-_";
  if (key.empty() || renamed.size() >= letters.size() || renamed.contains(at)) return false;
  text.replace(first, key.size(), std::string(key.size(), letters[letters.size() - 1 - renamed.size()]));
  renamed.emplace(at, std::move(key));
  return true;
}

bool is_duplicate(const toml::parse_error& error) {
  return error.description().find("cannot redefine existing") != std::string_view::npos;
}

/// "Error while parsing string: …" says less than what follows it.
std::string reason_of(const toml::parse_error& error) {
  std::string_view text = error.description();
  if (const auto colon = text.find(": ");
      text.starts_with("Error while") && colon != std::string_view::npos) {
    text.remove_prefix(colon + 2);
  }
  return std::string(text);
}

/// Bytes that the character of a \u escape takes in UTF-8.
std::size_t utf8_length(const std::string& hexadecimal) {
  const unsigned long code = std::strtoul(hexadecimal.c_str(), nullptr, 16);
  return code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
}

/// Past a backslash at the end of a line, with all space behind it.
std::size_t skip_continuation(const std::string& text, std::size_t at) {
  while (at + 1 < text.size() && text[at] == '\\' &&
         std::isspace(static_cast<unsigned char>(text[at + 1])) != 0) {
    at = std::min(text.find_first_not_of(" \t\r\n", at + 1), text.size());
  }
  return at;
}

/// What a parser must not see. True when the text is fit.
bool check_encoding(const SourceText& source, Diagnostics& diagnostics) {
  if (const auto bad = find_invalid_utf8(source.text())) {
    diagnostics.error(source.position(*bad),
                      message::not_utf8(static_cast<unsigned char>(source.text()[*bad])));
    return false;
  }
  if (const auto deep = find_deep_nesting(source.text(), deepest_nesting)) {
    diagnostics.error(source.position(*deep), message::nested_too_deeply(deepest_nesting));
    return false;
  }
  return true;
}

}  // namespace

const TomlValue* TomlValue::find(std::string_view key) const {
  const auto found = std::ranges::find(entries, key, &TomlEntry::key);
  return found == entries.end() ? nullptr : &found->value;
}

Position TomlDocument::inside(const TomlValue& string, std::size_t offset) const {
  const std::string& text = source_.text();
  std::size_t at = source_.offset(string.at);
  if (at >= text.size()) return string.at;
  const char quote = text[at];
  const bool multiline = text.compare(at, 3, std::string(3, quote)) == 0;
  at += multiline ? 3 : 1;
  // A line break right after the opening quotes does not belong to the string.
  if (multiline && text.compare(at, 2, "\r\n") == 0) ++at;
  if (multiline && at < text.size() && text[at] == '\n') ++at;
  if (quote != '"') return source_.position(at + offset);
  at = skip_continuation(text, at);
  for (std::size_t decoded = 0; decoded < offset && at < text.size();) {
    const bool escape = text[at] == '\\' && at + 1 < text.size();
    const std::size_t digits = !escape ? 0 : text[at + 1] == 'u' ? 4 : text[at + 1] == 'U' ? 8 : 0;
    decoded += digits > 0 ? utf8_length(text.substr(at + 2, digits)) : 1;
    at = skip_continuation(text, at + (escape ? 2 + digits : 1));
  }
  return source_.position(at);
}

std::optional<TomlDocument> parse_toml(std::string_view text, Diagnostics& diagnostics, int number) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  SourceText source(std::string(text), number);
  if (!check_encoding(source, diagnostics)) return std::nullopt;
  Renamed renamed;
  std::string readable = source.text();
  toml::parse_result parsed = toml::parse(readable);
  while (!parsed) {
    const toml::parse_error& error = parsed.error();
    const Position at = position_of(error.source().begin, source);
    if (is_duplicate(error) && rename_key_before(at, readable, renamed)) {
      parsed = toml::parse(readable);
      continue;
    }
    for (const auto& [where, key] : renamed) diagnostics.error(where, message::stands_twice(key));
    diagnostics.error(at, is_duplicate(error) ? message::section_stands_twice(reason_of(error))
                                              : message::syntax(reason_of(error)));
    return std::nullopt;
  }
  TomlValue root = Converter(source, renamed, diagnostics).value(parsed.table());
  return TomlDocument(std::move(source), std::move(root));
}

bool same_content(const TomlValue& a, const TomlValue& b) {
  const auto same_entry = [](const TomlEntry& x, const TomlEntry& y) {
    return x.key == y.key && same_content(x.value, y.value);
  };
  return a.kind == b.kind && a.flag == b.flag && a.number == b.number && a.integer == b.integer &&
         (a.is(TomlValue::Kind::number) || a.text == b.text) &&
         std::ranges::equal(a.items, b.items, same_content) &&
         std::ranges::equal(a.entries, b.entries, same_entry);
}

}  // namespace flyball
