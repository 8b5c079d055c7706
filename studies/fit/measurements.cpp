#include "studies/fit/measurements.h"

#include <algorithm>
#include <optional>

#include "models/language/csv.h"
#include "models/language/messages.h"
#include "models/language/units.h"
#include "studies/file.h"
#include "studies/fit/fit.h"
#include "studies/language/study_messages.h"

namespace flyball {
namespace {

std::string listing(const Diagnostics& diagnostics) {
  std::string lines;
  for (const Diagnostic& diagnostic : diagnostics.sorted()) {
    if (!lines.empty()) lines += '\n';
    lines += to_string(diagnostic);
  }
  return lines;
}

/// Nothing where it is not known, or has no name that is read back, such as the root of a second.
std::optional<Dimension> dimension_of(const std::string& unit) {
  try {
    return declared_dimension(unit);
  } catch (const TextError&) {
    return std::nullopt;
  }
}

/// A column without unit is in the unit of its signal, in SI.
void require_same_dimension(const TimeSeries& series, const LogColumn& signal, Diagnostics& diagnostics) {
  const auto wanted = dimension_of(signal.unit), found = dimension_of(series.unit);
  if (wanted && found && *wanted != *found)
    diagnostics.error({1, 1}, message::wrong_dimension(series.unit, *wanted, *found));
}

void require_times_of_a_run(const std::vector<double>& times, Diagnostics& diagnostics) {
  if (times.front() < 0.0) {
    diagnostics.error({CsvTable::line_of(0), 1}, message::data_before_start(times.front()));
  } else if (times.back() == 0.0) {
    diagnostics.error({CsvTable::line_of(0), 1}, message::data_at_start_only());
  }
}

}  // namespace

Measurements read_measurements(const FitExperiment& experiment, const std::vector<LogColumn>& columns) {
  Diagnostics diagnostics(experiment.data);
  const auto table = read_csv(read_file(experiment.data), diagnostics);
  Measurements result;
  for (std::size_t m = 0; table && m < experiment.matches.size(); ++m) {
    const FitExperiment::Match& match = experiment.matches[m];
    const auto series = read_time_series(*table, match.column, diagnostics);
    if (!series) break;
    require_same_dimension(*series, *std::ranges::find(columns, match.signal, &LogColumn::name), diagnostics);
    if (m == 0) {
      result.times = series->times;
      require_times_of_a_run(result.times, diagnostics);
      result.values.resize(result.times.size() * experiment.matches.size());
    }
    for (std::size_t row = 0; row < series->values.size(); ++row)
      result.values[row * experiment.matches.size() + m] = series->values[row];
  }
  if (diagnostics.failed()) throw FitError(listing(diagnostics));
  return result;
}

}  // namespace flyball
