#pragma once

#include <string>
#include <vector>

#include "studies/engine/bisect.h"

namespace flyball {

/// A row a limit, for bisections.csv and for people.
std::string bisections_csv(const Study& study, const std::vector<BisectResult>& results);
std::string bisections_text(const Study& study, const std::vector<BisectResult>& results);

}  // namespace flyball
