#include "models/language/nearest.h"

#include <algorithm>
#include <cctype>

namespace flyball {
namespace {

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  const std::size_t columns = b.size() + 1;
  std::vector<int> two_before(columns), before(columns), row(columns);
  for (std::size_t j = 0; j < columns; ++j) row[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    two_before.swap(before);
    before.swap(row);
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j < columns; ++j) {
      const int differs = lower(a[i - 1]) == lower(b[j - 1]) ? 0 : 1;
      row[j] = std::min({before[j] + 1, row[j - 1] + 1, before[j - 1] + differs});
      const bool swapped =
          i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], two_before[j - 2] + 1);
    }
  }
  return row.back();
}

std::optional<std::string> nearest(std::string_view name, const std::vector<std::string>& candidates) {
  // Long texts are no misspelt names, and the distance is quadratic; of two letters, one that differs leaves
  // too little in common.
  constexpr std::size_t shortest = 3;
  constexpr std::size_t longest = 64;
  if (name.size() < shortest || name.size() > longest) return std::nullopt;
  int best = (name.size() == shortest ? 1 : std::max(2, static_cast<int>(name.size()) / 3)) + 1;
  std::optional<std::string> found;
  for (const std::string& candidate : candidates) {
    const auto difference = static_cast<int>(candidate.size()) - static_cast<int>(name.size());
    if (difference >= best || -difference >= best) continue;
    const int distance = edit_distance(name, candidate);
    if (distance >= best) continue;
    best = distance;
    found = candidate;
  }
  return found;
}

}  // namespace flyball
