#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "models/diagram.h"
#include "solvers/log.h"

namespace flyball::test {

struct HandMadeColumn {
  std::string name;
  std::string unit;
  std::function<double(double)> value;
};

/// A log that no run made: columns are functions of time.
inline Log hand_made_log(const std::vector<HandMadeColumn>& columns, double end, double step) {
  Plan plan;
  for (const HandMadeColumn& column : columns) plan.columns.push_back({column.name, column.unit, -1});
  Log log(plan);
  const long steps = std::lround(end / step);
  for (long k = 0; k <= steps; ++k) {
    std::vector<double> row{static_cast<double>(k) * step};
    for (const HandMadeColumn& column : columns) row.push_back(column.value(row[0]));
    log.append_row(row);
  }
  return log;
}

}  // namespace flyball::test
