#include "models/language/names.h"

#include <cctype>

namespace flyball {

std::string_view leading_name(std::string_view text) {
  std::size_t end = 0;
  const auto letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  while (end < text.size() && (letter(text[end]) || (end > 0 && digit(text[end])))) ++end;
  return text.substr(0, end);
}

bool is_name(std::string_view text) { return !text.empty() && leading_name(text).size() == text.size(); }

std::string_view first_character(std::string_view text) {
  const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; };
  std::size_t end = text.empty() ? 0 : 1;
  while (end < text.size() && continues(text[end])) ++end;
  return text.substr(0, end);
}

}  // namespace flyball
