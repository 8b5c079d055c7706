#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "models/language/expression.h"
#include "studies/metrics/program.h"

namespace flyball {

/// Parses expressions over logged signals and calls of measures, and collects the calls in an order in which
/// they can be evaluated. What is wrong is thrown as TextError.
class SeriesParser : private Calls {
 public:
  /// Files are found from `folder`. The arguments outlive it.
  SeriesParser(std::string_view text, const std::vector<LogColumn>& columns,
               const std::filesystem::path& folder);

  /// Parses from `at`, and not beyond `end`; moves `at` behind what was read.
  SeriesExpression expression(std::size_t& at, std::size_t end, Wanted wanted = Wanted::number);
  /// The same, and it must have one value for a run.
  SeriesExpression number(std::size_t& at, std::size_t end);
  /// Throws at the first signal of an expression that must be a number.
  void require_number(const SeriesExpression& expression) const;
  void require_dimension(const SeriesExpression& expression, const Quantity& wanted) const;

  /// A file name in quotes, or up to a blank, comma or parenthesis.
  std::filesystem::path file_name(std::size_t& at, std::size_t end) const;
  std::size_t skip_space(std::size_t at) const;

  const std::vector<MeasureCall>& calls() const { return calls_; }
  std::vector<MeasureCall> take_calls() { return std::move(calls_); }

 private:
  struct Argument;

  std::optional<std::string> read(std::string_view name, std::string_view text, std::size_t& at) override;
  std::vector<std::string> names() const override;

  void read_arguments(MeasureCall& call, std::size_t& at, std::size_t end);
  void read_argument(MeasureCall& call, std::size_t parameter, std::size_t& at, std::size_t end);
  std::size_t parameter_named(const MeasureCall& call, std::string_view name, std::size_t offset) const;
  void check(MeasureCall& call) const;
  Quantity quantity_of(const MeasureCall& call) const;
  Quantity quantity_of(const SeriesExpression::Operand& operand) const;
  SeriesExpression::Operand operand_named(const std::string& name) const;

  std::string_view text_;
  const std::vector<LogColumn>& columns_;
  const std::filesystem::path& folder_;
  std::vector<std::string> signals_;
  std::vector<MeasureCall> calls_;
  std::map<std::string, std::string, std::less<>> known_calls_;  // operand by text
  int depth_ = 0;
};

}  // namespace flyball
