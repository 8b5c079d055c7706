#include "solvers/log.h"

namespace flyball {

Log::Log(const Plan& plan) : columns_(plan.columns) {}

bool Log::keep_row(double sum_of_zeros) {
  if (sum_of_zeros == 0.0) return true;
  data_.resize(data_.size() - columns_.size() - 1);
  return false;
}

bool Log::append(const std::vector<double>& values) {
  data_.push_back(values[0]);
  double zero = 0.0;  // 0 times a finite number
  for (const LogColumn& column : columns_) {
    data_.push_back(values[column.slot]);
    zero += 0.0 * data_.back();
  }
  return keep_row(zero);
}

bool Log::append(double time, const double* row) {
  data_.push_back(time);
  double zero = 0.0;
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    data_.push_back(row[k]);
    zero += 0.0 * row[k];
  }
  return keep_row(zero);
}

void Log::read(const std::vector<double>& values, std::vector<double>& row) const {
  row.assign(1, values[0]);
  for (const LogColumn& column : columns_) row.push_back(values[column.slot]);
}

}  // namespace flyball
