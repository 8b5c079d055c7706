#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "models/diagram.h"
#include "solvers/zeros.h"

namespace flyball {

/// The times at which a run is asked for a row: those of a list; without one k * interval, rounded once, a
/// thousandth of the run where no interval is given.
class AskedTimes {
 public:
  explicit AskedTimes(const SimulationSettings& settings, std::vector<double> list = {})
      : list_(std::move(list)),
        step_(settings.log_interval ? static_cast<double>(settings.log_interval->numerator())
                                    : settings.stop),
        divisor_(settings.log_interval ? static_cast<double>(settings.log_interval->denominator()) : 1000.0) {
  }

  double time(std::int64_t k) const {
    if (list_.empty()) return static_cast<double>(k) * step_ / divisor_;
    const auto n = static_cast<std::size_t>(k);
    return n < list_.size() ? list_[n] : std::numeric_limits<double>::infinity();
  }
  bool is(std::int64_t k, double t) const { return std::fabs(time(k) - t) <= same_instant(t); }
  /// How many there are in a run of this length, at most.
  std::int64_t count(double stop) const {
    if (!list_.empty()) return static_cast<std::int64_t>(list_.size());
    return static_cast<std::int64_t>(stop / step_ * divisor_) + 2;
  }

 private:
  std::vector<double> list_;
  double step_, divisor_;
};

}  // namespace flyball
