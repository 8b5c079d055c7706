#include "models/language/source_text.h"

#include <algorithm>

namespace flyball {
namespace {

// Columns are asked for by the thousand in generated lines: none is counted from the start of its line.
constexpr std::size_t stretch = 256;

bool continues(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

/// Length of the sequence that starts with this byte, 0 when none does.
int sequence_length(unsigned char first) {
  if (first < 0x80) return 1;
  if (first < 0xC2) return 0;
  if (first < 0xE0) return 2;
  if (first < 0xF0) return 3;
  return first < 0xF5 ? 4 : 0;
}

/// Overlong forms, surrogates and numbers beyond Unicode show in the second byte.
bool valid_second(unsigned char first, unsigned char second) {
  if (first == 0xE0) return second >= 0xA0;
  if (first == 0xED) return second < 0xA0;
  if (first == 0xF0) return second >= 0x90;
  if (first == 0xF4) return second < 0x90;
  return true;
}

/// Past the string that opens at `at`; where it is not closed, the end of its line or of the text.
std::size_t skip_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string three(3, quote);
  const bool multiline = text.substr(at, 3) == three;
  at += multiline ? 3 : 1;
  while (at < text.size()) {
    if (quote == '"' && text[at] == '\\') {
      at += 2;
    } else if (multiline ? text.substr(at, 3) == three : text[at] == quote) {
      return at + (multiline ? 3 : 1);
    } else if (!multiline && text[at] == '\n') {
      return at;
    } else {
      ++at;
    }
  }
  return text.size();
}

}  // namespace

SourceText::SourceText(std::string text, int number)
    : text_(std::move(text)), number_(number), line_starts_{0} {
  for (std::size_t at = text_.find('\n'); at != std::string::npos; at = text_.find('\n', at + 1)) {
    line_starts_.push_back(at + 1);
  }
  std::size_t count = 0;
  for (std::size_t at = 0; at <= text_.size(); ++at) {
    if (at % stretch == 0) continued_.push_back(count);
    if (at < text_.size() && continues(text_[at])) ++count;
  }
}

std::size_t SourceText::continued(std::size_t offset) const {
  const auto first = text_.begin() + static_cast<std::ptrdiff_t>(offset - offset % stretch);
  const auto last = text_.begin() + static_cast<std::ptrdiff_t>(offset);
  return continued_[offset / stretch] + static_cast<std::size_t>(std::count_if(first, last, continues));
}

Position SourceText::position(std::size_t offset) const {
  offset = std::min(offset, text_.size());
  const auto line = std::ranges::upper_bound(line_starts_, offset) - line_starts_.begin();
  const std::size_t start = line_starts_[line - 1];
  const std::size_t characters = offset - start - (continued(offset) - continued(start));
  return {static_cast<int>(line), static_cast<int>(characters) + 1, number_};
}

std::size_t SourceText::offset(Position at) const {
  if (at.line < 1 || at.line > static_cast<int>(line_starts_.size())) return text_.size();
  const std::size_t start = line_starts_[at.line - 1];
  const std::size_t characters = static_cast<std::size_t>(std::max(at.column, 1)) - 1;
  // Each guess is as many bytes further as the one before left out; none is too far.
  std::size_t result = std::min(start + characters, text_.size());
  for (std::size_t before = start; result != before;) {
    before = result;
    result = std::min(start + characters + (continued(result) - continued(start)), text_.size());
  }
  while (result < text_.size() && continues(text_[result])) ++result;
  return result;
}

std::optional<std::size_t> find_invalid_utf8(std::string_view text) {
  std::size_t at = 0;
  while (at < text.size()) {
    const auto first = static_cast<unsigned char>(text[at]);
    const int length = sequence_length(first);
    if (length == 0 || at + length > text.size()) return at;
    if (length > 1 && !valid_second(first, static_cast<unsigned char>(text[at + 1]))) return at;
    for (int k = 1; k < length; ++k) {
      if (!continues(text[at + k])) return at;
    }
    at += length;
  }
  return std::nullopt;
}

std::optional<std::size_t> find_long_line(std::string_view text, std::size_t limit) {
  for (std::size_t start = 0; text.size() - start > limit;) {
    const std::size_t end = text.find('\n', start);
    if (end == std::string_view::npos || end - start > limit) return start + limit;
    start = end + 1;
  }
  return std::nullopt;
}

std::optional<std::size_t> find_deep_nesting(std::string_view text, int limit) {
  int depth = 0;
  int dots = 0;
  std::size_t at = 0;
  while (at < text.size()) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      at = skip_string(text, at);
      continue;
    }
    if (c == '#') {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    if (c == '[' || c == '{') ++depth;
    if ((c == ']' || c == '}') && depth > 0) --depth;
    dots = c == '.' ? dots + 1 : (std::string_view("=,[]{}\n").find(c) != std::string_view::npos ? 0 : dots);
    if (depth > limit || dots > limit) return at;
    ++at;
  }
  return std::nullopt;
}

}  // namespace flyball
