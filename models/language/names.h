#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>

namespace flyball {

struct NameHash {
  using is_transparent = void;
  std::size_t operator()(std::string_view name) const { return std::hash<std::string_view>{}(name); }
};

/// Looked up by std::string_view without a copy.
template <class V>
using NameMap = std::unordered_map<std::string, V, NameHash, std::equal_to<>>;
using NameIndex = NameMap<int>;

/// [A-Za-z_][A-Za-z0-9_]*
bool is_name(std::string_view text);
/// The name that a text starts with; empty when it starts with none.
std::string_view leading_name(std::string_view text);
/// The first character of UTF-8 text with all its bytes; empty at the end.
std::string_view first_character(std::string_view text);

}  // namespace flyball
