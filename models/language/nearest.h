#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flyball {

/// Insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`. Case does not count:
/// "gain" and "Gain" are 0 apart.
int edit_distance(std::string_view a, std::string_view b);

/// The candidate that `name` was probably meant to be: at most two of its letters differ, or a third.
std::optional<std::string> nearest(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace flyball
