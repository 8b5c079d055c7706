#include "solvers/log.h"

namespace flyball {

Log::Log(const Plan& plan) : columns_(plan.columns) {}

void Log::append(const std::vector<double>& values) {
  data_.push_back(values[0]);
  for (const LogColumn& column : columns_) data_.push_back(values[column.slot]);
}

void Log::read(const std::vector<double>& values, std::vector<double>& row) const {
  row.assign(1, values[0]);
  for (const LogColumn& column : columns_) row.push_back(values[column.slot]);
}

}  // namespace flyball
