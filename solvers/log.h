#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "models/plan.h"

namespace flyball {

/// Which rows an instant gives besides the asked times: before and after each jump, after only, or none.
enum class EventRows { both, after, none };

/// What a run recorded: rows of time and one number a column, in order of time.
class Log {
 public:
  explicit Log(const Plan& plan);

  int width() const { return static_cast<int>(columns_.size()); }
  std::int64_t rows() const { return static_cast<std::int64_t>(data_.size()) / (width() + 1); }
  const std::vector<LogColumn>& columns() const { return columns_; }
  double time(std::int64_t row) const { return data_[row * (width() + 1)]; }
  double value(std::int64_t row, int column) const { return data_[row * (width() + 1) + 1 + column]; }
  /// Rows of width() + 1 numbers, time first.
  const std::vector<double>& data() const { return data_; }

  void reserve(std::int64_t rows) { data_.reserve(static_cast<std::size_t>(rows) * (width() + 1)); }
  /// Appends the logged slots of a value array. False, and nothing appended, when one of them is not finite.
  bool append(const std::vector<double>& values);
  /// The same for width() values that were computed elsewhere.
  bool append(double time, const double* row);
  void append_row(const std::vector<double>& row) { data_.insert(data_.end(), row.begin(), row.end()); }
  /// The row that `append` would append.
  void read(const std::vector<double>& values, std::vector<double>& row) const;

 private:
  bool keep_row(double sum_of_zeros);

  std::vector<LogColumn> columns_;
  std::vector<double> data_;
};

}  // namespace flyball
