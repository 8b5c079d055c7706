#include "studies/metrics/tube.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "studies/metrics/data_table.h"
#include "studies/metrics/messages.h"

namespace flyball {

double TubeReader::Largest::edge(double time) const {
  const auto& times = curve->times;
  const auto behind = static_cast<std::size_t>(std::ranges::upper_bound(times, time) - times.begin());
  if (behind == 0) return curve->values.front();
  if (behind == times.size()) return curve->values.back();
  const double part = (time - times[behind - 1]) / (times[behind] - times[behind - 1]);
  return curve->values[behind - 1] + part * (curve->values[behind] - curve->values[behind - 1]);
}

double TubeReader::Largest::within(double from, double to) {
  const auto value = [&](std::size_t k) { return sign * curve->values[k]; };
  for (; next < curve->times.size() && curve->times[next] <= to; ++next) {
    while (candidates.size() > first && value(candidates.back()) <= value(next)) candidates.pop_back();
    candidates.push_back(next);
  }
  while (first < candidates.size() && curve->times[candidates[first]] < from) ++first;
  double largest = std::max(sign * edge(from), sign * edge(to));
  if (first < candidates.size()) largest = std::max(largest, value(candidates[first]));
  return largest;
}

TubeLimits TubeReader::at(double time) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double from = time - tube_.time, to = time + tube_.time;
  const auto tolerance = [&](double value) { return tube_.absolute + tube_.relative * std::fabs(value); };
  TubeLimits limits{-infinity, infinity};
  if (low_.curve != nullptr) {
    const double lowest = -low_.within(from, to);
    limits.lower = lowest - tolerance(lowest);
  }
  if (high_.curve != nullptr) {
    const double highest = high_.within(from, to);
    limits.upper = highest + tolerance(highest);
  }
  return limits;
}

Tube read_envelope(const std::filesystem::path& file) {
  const DataTable table(file);
  Tube tube;
  if (table.has("lower")) tube.lower = table.series("lower");
  if (table.has("upper")) tube.upper = table.series("upper");
  const auto refuse = [&](int line, const std::string& problem) {
    throw std::runtime_error(file.string() + ":" + std::to_string(line) + ":1: error: " + problem);
  };
  if (!tube.lower && !tube.upper) refuse(1, message::envelope_without_bounds());
  if (tube.lower && tube.upper) {
    if (tube.lower->unit != tube.upper->unit) refuse(1, message::envelope_units());
    for (std::size_t k = 0; k < tube.lower->values.size(); ++k) {
      if (tube.lower->values[k] > tube.upper->values[k])
        refuse(CsvTable::line_of(static_cast<int>(k)), message::envelope_reversed(tube.lower->times[k]));
    }
  }
  return tube;
}

Tube read_baseline(const std::filesystem::path& file, const std::string& column) {
  const DataTable table(file);
  // Of a file with two columns, the name of the second does not matter.
  const bool only = table.width() == 2 && !table.has(column);
  Tube tube;
  tube.lower = tube.upper = table.series(only ? "" : column);
  tube.whole = true;
  return tube;
}

}  // namespace flyball
