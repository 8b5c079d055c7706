#include "studies/metrics/metric.h"

#include <algorithm>

#include "models/language/messages.h"
#include "models/language/names.h"
#include "models/language/units.h"
#include "studies/metrics/program.h"
#include "studies/metrics/series_parser.h"

namespace flyball {

struct Metric::Program {
  std::string text, unit;
  std::vector<MeasureCall> calls;
  SeriesExpression result;
};

Metric::Metric(std::string_view text, const std::vector<LogColumn>& columns,
               const std::filesystem::path& folder) {
  SeriesParser parser(text, columns, folder);
  std::size_t at = 0;
  auto program = std::make_shared<Program>();
  program->result = parser.number(at, text.size());
  if (at < text.size()) throw TextError(at, message::unexpected(first_character(text.substr(at))));
  program->text = text;
  program->unit = unit_of(program->result.quantity);
  program->calls = parser.take_calls();
  program_ = std::move(program);
}

double Metric::evaluate(const Log& log, const RunStatistics& statistics) const {
  return Evaluation(program_->calls, log, statistics).number(program_->result);
}

const std::string& Metric::unit() const { return program_->unit; }

const std::string& Metric::text() const { return program_->text; }

bool Metric::reads_end_only() const {
  return std::ranges::all_of(program_->calls, &MeasureCall::reads_end_only);
}

}  // namespace flyball
