#include "solvers/step_failure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace flyball {

std::vector<int> worst_places(const std::vector<double>& weighted) {
  const auto size = [&](int i) {
    return std::isnan(weighted[i]) ? std::numeric_limits<double>::infinity() : std::fabs(weighted[i]);
  };
  std::vector<int> places(weighted.size());
  std::iota(places.begin(), places.end(), 0);
  const auto shown = std::min<std::size_t>(3, places.size());
  std::partial_sort(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(shown), places.end(),
                    [&](int a, int b) { return size(a) != size(b) ? size(a) > size(b) : a < b; });
  places.resize(shown);
  return places;
}

std::string to_string(const std::vector<WeightedError>& errors) {
  std::string text;
  for (const WeightedError& error : errors) {
    text += fmt::format("{}{}: error {:.2g} times the tolerance", text.empty() ? "" : "; ", error.state,
                        std::fabs(error.multiple));
  }
  return text;
}

SimulationError step_vanished(double time, double step, const std::vector<WeightedError>& worst) {
  return {SimulationError::Kind::step_vanished, time,
          fmt::format("the step vanished: at t = {:.10g} s only {:.2g} s would meet the tolerance ({})", time,
                      step, to_string(worst))};
}

}  // namespace flyball
