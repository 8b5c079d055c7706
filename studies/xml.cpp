#include "studies/xml.h"

#include <array>
#include <utility>

#include "models/language/source_text.h"

namespace flyball {
namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";

std::string_view entity(char c, bool attribute) {
  constexpr std::array<std::pair<char, std::string_view>, 4> always{
      {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}}};
  // A reader of XML makes a blank of them in attributes.
  constexpr std::array<std::pair<char, std::string_view>, 2> blanks{{{'\n', "&#10;"}, {'\t', "&#9;"}}};
  for (const auto& [special, name] : always) {
    if (c == special) return name;
  }
  for (const auto& [special, name] : blanks) {
    if (c == special) return attribute ? name : std::string_view();
  }
  return static_cast<unsigned char>(c) < ' ' ? replacement : std::string_view();
}

std::string escaped(std::string_view text, bool attribute) {
  std::string result;
  for (const char c : valid_text(text)) {
    const std::string_view name = entity(c, attribute);
    name.empty() ? result += c : result += name;
  }
  return result;
}

}  // namespace

std::string valid_text(std::string_view text) {
  std::string result;
  while (true) {
    const std::size_t bad = find_invalid_utf8(text).value_or(text.size());
    result += text.substr(0, bad);
    if (bad == text.size()) return result;
    result += replacement;
    text.remove_prefix(bad + 1);
  }
}

std::string xml_text(std::string_view text) { return escaped(text, false); }

std::string xml_attribute(std::string_view text) { return escaped(text, true); }

}  // namespace flyball
