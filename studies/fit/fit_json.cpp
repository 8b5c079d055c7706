#include <cmath>
#include <nlohmann/json.hpp>

#include "studies/fit/fit_files.h"
#include "studies/versions.h"

namespace flyball {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no NaN.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json parameters_of(const FitResult& result) {
  Json json = Json::array();
  for (const FittedParameter& p : result.parameters) {
    json.push_back({{"name", p.name},
                    {"unit", p.unit},
                    {"start", p.start},
                    {"value", number(p.value)},
                    {"standard_error", number(p.standard_error)},
                    {"at_bound", p.at_bound}});
  }
  return json;
}

Json correlation_of(const FitResult& result) {
  const std::size_t n = result.parameters.size();
  Json rows = Json::array();
  for (std::size_t p = 0; p < n && !result.correlation.empty(); ++p) {
    Json row = Json::array();
    for (std::size_t q = 0; q < n; ++q) row.push_back(number(result.correlation[p * n + q]));
    rows.push_back(std::move(row));
  }
  return rows;
}

Json experiments_of(const FitResult& result) {
  Json json = Json::array();
  for (const FittedExperiment& experiment : result.experiments) {
    Json signals = Json::array();
    for (const FittedSignal& signal : experiment.signals)
      signals.push_back({{"signal", signal.signal}, {"column", signal.column}});
    json.push_back({{"name", experiment.name},
                    {"data", experiment.data},
                    {"rows", experiment.times.size()},
                    {"signals", std::move(signals)}});
  }
  return json;
}

}  // namespace

std::string fit_json(const FitResult& result, const FitInputs& inputs) {
  const Json json = {{"flyball", flyball_version()},
                     {"fit", result.name},
                     {"model", inputs.model_file},
                     {"converged", result.converged},
                     {"reason", result.reason},
                     {"parameters", parameters_of(result)},
                     {"correlation", correlation_of(result)},
                     {"condition", number(result.condition)},
                     {"cost_before", number(result.cost_before)},
                     {"cost", number(result.cost)},
                     {"residuals", result.residuals},
                     {"simulations", result.simulations},
                     {"iterations", result.iterations},
                     {"gradient", result.gradient},
                     {"remarks", result.remarks},
                     {"experiments", experiments_of(result)}};
  // A path need not be UTF-8, JSON must be.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace flyball
