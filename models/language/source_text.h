#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "models/language/diagnostics.h"

namespace flyball {

/// A text with its lines, to turn byte offsets into positions and back. Columns count characters (code
/// points).
class SourceText {
 public:
  /// Its positions are in source `number` of the diagnostics.
  explicit SourceText(std::string text, int number = 0);

  int number() const { return number_; }

  const std::string& text() const { return text_; }
  Position position(std::size_t offset) const;
  /// The end of the text for a position outside it.
  std::size_t offset(Position at) const;

 private:
  /// Bytes before `offset` that continue a character.
  std::size_t continued(std::size_t offset) const;

  std::string text_;
  int number_;
  std::vector<std::size_t> line_starts_;
  std::vector<std::size_t> continued_;  // before each stretch of bytes
};

/// Offset of the first byte that is not UTF-8.
std::optional<std::size_t> find_invalid_utf8(std::string_view text);

/// Offset at which a line gets longer than `limit` bytes.
std::optional<std::size_t> find_long_line(std::string_view text, std::size_t limit);

/// Offset at which a TOML text goes deeper than `limit` brackets, or `limit` dots of one key. Judged before
/// the text is parsed, because parsers and destructors recurse.
std::optional<std::size_t> find_deep_nesting(std::string_view text, int limit);

}  // namespace flyball
