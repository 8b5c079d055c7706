#include "studies/metrics/requirement.h"

#include <algorithm>
#include <cmath>

#include "studies/metrics/requirement_parser.h"

namespace flyball {

struct Requirement::Program {
  std::string text, unit;
  std::vector<MeasureCall> calls;
  std::vector<Clause> clauses;
};

namespace {

bool is_of_numbers(const Clause& clause) {
  const auto* comparison = std::get_if<Comparison>(&clause.statement);
  return comparison != nullptr && comparison->when == Comparison::When::number;
}

/// Whether a verdict is the one to tell rather than another one.
bool worse(const Verdict& a, const Verdict& b) {
  if (std::isnan(a.margin) != std::isnan(b.margin)) return std::isnan(a.margin);
  if (a.margin != b.margin) return a.margin < b.margin;
  return !a.passed && b.passed;
}

}  // namespace

Requirement::Requirement(std::string_view text, const std::vector<LogColumn>& columns,
                         const std::filesystem::path& folder) {
  SeriesParser parser(text, columns, folder);
  auto program = std::make_shared<Program>();
  program->text = text;
  program->clauses = parse_clauses(text, parser);
  program->calls = parser.take_calls();
  program->unit = program->clauses.front().si_unit;
  program_ = std::move(program);
}

Verdict Requirement::check(const Log& log, const RunStatistics& statistics) const {
  const Evaluation evaluation(program_->calls, log, statistics);
  Verdict worst;
  bool passed = true;
  for (const Clause& clause : program_->clauses) {
    const Verdict verdict = flyball::check(clause, evaluation);
    passed = passed && verdict.passed;
    if (&clause == &program_->clauses.front() || worse(verdict, worst)) worst = verdict;
  }
  worst.passed = passed;
  return worst;
}

const std::string& Requirement::text() const { return program_->text; }

const std::string& Requirement::unit() const { return program_->unit; }

bool Requirement::reads_end_only() const {
  return std::ranges::all_of(program_->calls, &MeasureCall::reads_end_only) &&
         std::ranges::all_of(program_->clauses, is_of_numbers);
}

}  // namespace flyball
