#include "studies/metrics/program.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

using Operand = SeriesExpression::Operand;

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

/// Of row k and the next one, at a time between them.
double between(const std::vector<double>& time, const std::vector<double>& value, std::size_t k, double t) {
  return value[k] + (t - time[k]) / (time[k + 1] - time[k]) * (value[k + 1] - value[k]);
}

}  // namespace

bool SeriesExpression::is_number() const {
  return std::ranges::all_of(operands, [](const Operand& o) { return o.kind == Operand::Kind::number; });
}

std::string unit_of(const Quantity& quantity) {
  if (quantity.known()) return to_string(quantity.dimension);
  return quantity.kind == Quantity::Kind::free ? "1" : "";
}

Evaluation::Evaluation(const std::vector<MeasureCall>& calls, const Log& log, const RunStatistics& statistics)
    : log_(log), statistics_(statistics) {
  time_.reserve(static_cast<std::size_t>(log.rows()));
  for (std::int64_t row = 0; row < log.rows(); ++row) time_.push_back(log.time(row));
  for (const MeasureCall& call : calls) results_.push_back(result_of(call));
}

double Evaluation::at(const SeriesExpression& expression, std::int64_t row) const {
  const auto operand = [&](int k) {
    const auto& [kind, index] = expression.operands[static_cast<std::size_t>(k)];
    switch (kind) {
      case Operand::Kind::column:
        return log_.value(row, index);
      case Operand::Kind::time:
        return log_.time(row);
      case Operand::Kind::number:
        return results_[static_cast<std::size_t>(index)].number;
      default:
        return results_[static_cast<std::size_t>(index)].series[static_cast<std::size_t>(row)];
    }
  };
  return expression.formula.evaluate<double>(operand, [](int, double a, double b) { return a > b; });
}

double Evaluation::number(const SeriesExpression& expression) const { return at(expression, 0); }

std::vector<double> Evaluation::series(const SeriesExpression& expression) const {
  std::vector<double> values;
  values.reserve(time_.size());
  const bool column = expression.formula.nodes.size() == 1 && !expression.operands.empty() &&
                      expression.operands[0].kind == Operand::Kind::column;
  for (std::int64_t row = 0; row < log_.rows(); ++row)
    values.push_back(column ? log_.value(row, expression.operands[0].index) : at(expression, row));
  return values;
}

Evaluation::Result Evaluation::result_of(const MeasureCall& call) const {
  const Measure& measure = *call.measure;
  const bool end_only = call.reads_end_only() && !time_.empty();
  std::vector<double> time = end_only ? std::vector{time_.back()} : time_;
  std::vector<std::vector<double>> values;
  MeasureInput input{{}, std::vector(measure.parameters.size(), undefined), call.path.get(), &statistics_};
  for (std::size_t k = 0; k < measure.parameters.size(); ++k) {
    const MeasureParameter::Kind kind = measure.parameters[k].kind;
    if (!call.arguments[k] || kind == MeasureParameter::Kind::path) continue;
    if (!MeasureParameter::over_time(kind)) {
      input.numbers[k] = number(*call.arguments[k]);
    } else if (end_only) {
      values.push_back({at(*call.arguments[k], log_.rows() - 1)});
    } else {
      values.push_back(series(*call.arguments[k]));
    }
  }
  const Window window{call.from ? number(*call.from) : undefined, call.to ? number(*call.to) : undefined};
  // A window without an answer is none: it must not become the whole run.
  if ((call.from && std::isnan(window.from)) || (call.to && std::isnan(window.to))) return {undefined, {}};
  if (call.from || call.to) clip(time, values, window);
  for (const std::vector<double>& value : values) input.signals.push_back({time, value});
  if (measure.series != nullptr) return {0.0, measure.series(input)};
  if (!values.empty() && time.empty()) return {undefined, {}};
  return {measure.value(input), {}};
}

void clip(std::vector<double>& time, std::vector<std::vector<double>>& values, const Window& window) {
  if (time.empty()) return;
  // The rows that are kept: from the last one at or before `from` to the first one at or behind `to`.
  std::size_t first = 0, last = time.size();
  if (window.from >= time.front())
    first = static_cast<std::size_t>(std::ranges::upper_bound(time, window.from) - time.begin()) - 1;
  if (window.to <= time.back())
    last = static_cast<std::size_t>(std::ranges::lower_bound(time, window.to) - time.begin()) + 1;
  // A window without width on a jump.
  last = std::max(last, first + 1);
  const bool none = window.from > time.back() || window.to < time.front() || window.to < window.from;
  const auto cut = [&](std::vector<double>& value) {
    if (none) return value.clear();
    // An end first: both may lie between the same two rows.
    double begin_value = value[first], end_value = value[last - 1];
    if (window.from > time[first]) begin_value = between(time, value, first, window.from);
    if (window.to < time[last - 1]) end_value = between(time, value, last - 2, window.to);
    value = std::vector(value.begin() + static_cast<std::ptrdiff_t>(first),
                        value.begin() + static_cast<std::ptrdiff_t>(last));
    value.front() = begin_value;
    value.back() = end_value;
  };
  for (std::vector<double>& value : values) cut(value);
  std::vector<double> clipped = time;
  cut(clipped);
  time = std::move(clipped);
}

}  // namespace flyball
