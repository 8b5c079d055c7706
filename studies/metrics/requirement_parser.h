#pragma once

#include <string_view>
#include <vector>

#include "studies/metrics/clause.h"
#include "studies/metrics/series_parser.h"

namespace flyball {

/// Reads the statements of a requirement; `parser` reads the expressions of the same text and keeps the calls
/// in them. Throws TextError.
std::vector<Clause> parse_clauses(std::string_view text, SeriesParser& parser);

}  // namespace flyball
