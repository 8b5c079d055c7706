#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "models/language/diagnostics.h"
#include "models/language/source_text.h"

namespace flyball {

struct TomlEntry;

/// A value of a TOML text, with the place where it stands.
struct TomlValue {
  enum class Kind { boolean, integer, number, string, date, list, table };

  Kind kind = Kind::table;
  Position at;
  int override_index = -1;  // the value came from this override, not from the file
  bool flag = false;
  std::int64_t integer = 0;
  double number = 0.0;  // of integers, too
  std::string text;     // of a string; of a number as it was written
  std::vector<TomlValue> items;
  std::vector<TomlEntry> entries;             // of a table, in the order of the text
  std::shared_ptr<const TomlValue> replaced;  // of an override: the value in the file

  bool is(Kind k) const { return kind == k; }
  bool numeric() const { return kind == Kind::integer || kind == Kind::number; }
  /// Linear in the number of entries; nullptr when there is none.
  const TomlValue* find(std::string_view key) const;
};

struct TomlEntry {
  std::string key;
  Position at;
  TomlValue value;
};

/// Whether two values say the same, wherever and however they stand in their texts.
bool same_content(const TomlValue& a, const TomlValue& b);

/// A parsed text. Only views of it are handed around, so it does not move.
class TomlDocument {
 public:
  TomlDocument(SourceText source, TomlValue root) : source_(std::move(source)), root_(std::move(root)) {}

  const TomlValue& root() const { return root_; }
  TomlValue& root() { return root_; }
  const std::string& text() const { return source_.text(); }
  /// Where byte `offset` of the content of `string` stands, whatever its quotes and escapes.
  Position inside(const TomlValue& string, std::size_t offset) const;

 private:
  SourceText source_;
  TomlValue root_;
};

/// Brackets and dotted keys deeper than this are refused, so that no text can exhaust the stack.
inline constexpr int deepest_nesting = 64;

/// No line is longer, in bytes. Whatever one line may hold, reading it and telling what is wrong with it
/// stays short.
inline constexpr std::size_t longest_line = 1'000'000;

/// Parses a text. Everything that is wrong is reported; nothing comes back when there is no tree to go on
/// with. NaN, infinities and keys that stand twice are reported; the tree holds the former, but not the
/// latter. Positions are in source `source` of the diagnostics.
std::optional<TomlDocument> parse_toml(std::string_view text, Diagnostics& diagnostics, int source = 0);

}  // namespace flyball
