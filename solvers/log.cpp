#include "solvers/log.h"

namespace flyball {

Log::Log(const Plan& plan) : columns_(plan.columns) {}

bool Log::append(const std::vector<double>& values) {
  double zero = 0.0;  // 0 times a finite number
  data_.push_back(values[0]);
  for (const LogColumn& column : columns_) {
    const double value = values[column.slot];
    zero += 0.0 * value;
    data_.push_back(value);
  }
  if (zero == 0.0) return true;
  data_.resize(data_.size() - columns_.size() - 1);
  return false;
}

void Log::read(const std::vector<double>& values, std::vector<double>& row) const {
  row.assign(1, values[0]);
  for (const LogColumn& column : columns_) row.push_back(values[column.slot]);
}

}  // namespace flyball
